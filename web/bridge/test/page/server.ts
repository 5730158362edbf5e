import { spawn, type ChildProcess } from 'node:child_process';
import { createServer } from 'node:net';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { startServer } from '../mock/server.mjs';

const web = fileURLToPath(new URL('../../../../build/web/bridge', import.meta.url));

/** The program under test; without one the mock server stands in for it. */
const program = process.env.PONTE_BIN;
export const usesPonte = program !== undefined;

export interface Options {
  tokens?: Record<string, 'watch' | 'command'>; // token: role
  wrongRoll?: boolean; // the mock server only
}

/** Something that serves the page, which a test can stop and start again at the same address. */
export class PageServer {
  private stop: () => Promise<void> = async () => {};

  private constructor(
    private readonly port: number,
    private readonly options: Options,
  ) {}

  static async start(options: Options = {}): Promise<PageServer> {
    const server = new PageServer(await freePort(), options);
    await server.restart();
    return server;
  }

  get url(): string {
    return `http://127.0.0.1:${this.port}/`;
  }

  async restart(): Promise<void> {
    await this.close();
    this.stop = program === undefined ? await this.startMock() : await this.startPonte(program);
  }

  close(): Promise<void> {
    return this.stop();
  }

  private async startMock(): Promise<() => Promise<void>> {
    return (await startServer({ port: this.port, web, ...this.options })).close;
  }

  private async startPonte(path: string): Promise<() => Promise<void>> {
    const vehicles = `127.0.0.1:${await freePort()}`;
    const http = ['--http', `127.0.0.1:${this.port}`, '--web-root', web];
    const vsm = spawn(path, ['vsm', '--vehicle', `udpin://${vehicles}`, '--dli', 'udpout://127.0.0.1:9', ...http], {
      stdio: 'inherit',
      env: { ...process.env, ...this.tokenVariables() },
    });
    const sim = spawn(path, ['sim', '--endpoint', `udpout://${vehicles}`, '--arm-after', '1'], { stdio: 'inherit' });
    await untilHealthy(`${this.url}healthz`, vsm);
    return async () => void (await Promise.all([ended(sim), ended(vsm)]));
  }

  private tokenVariables(): Record<string, string> {
    const tokens = Object.entries(this.options.tokens ?? {});
    return Object.fromEntries(tokens.map(([token, role]) => [`PONTE_HTTP_${role.toUpperCase()}_TOKEN`, token]));
  }
}

function ended(child: ChildProcess): Promise<void> {
  return new Promise((done) => {
    if (child.exitCode !== null) return done();
    child.once('exit', () => done());
    child.kill('SIGTERM');
  });
}

async function untilHealthy(address: string, child: ChildProcess): Promise<void> {
  for (;;) {
    if (child.exitCode !== null) throw new Error(`the program ended with status ${child.exitCode}`);
    const answer = await fetch(address).catch(() => undefined);
    if (answer?.ok) return;
    await pause(100);
  }
}

function freePort(): Promise<number> {
  return new Promise((resolve, reject) => {
    const probe = createServer();
    probe.on('error', reject);
    probe.listen(0, '127.0.0.1', () => {
      const address = probe.address();
      probe.close(() =>
        address !== null && typeof address === 'object' ? resolve(address.port) : reject(new Error('no port')),
      );
    });
  });
}
