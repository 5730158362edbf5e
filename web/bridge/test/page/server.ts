import { spawn } from 'node:child_process';
import { createServer } from 'node:net';
import { setTimeout as pause } from 'node:timers/promises';
import { fileURLToPath } from 'node:url';
import { startServer } from '../mock/server.mjs';

const web = fileURLToPath(new URL('../../../../build/web/bridge', import.meta.url));

/** The program under test; without one the mock server stands in for it. */
export const program = process.env.PONTE_BIN;
const longEnough_s = '3600';

export interface Options {
  tokens?: Record<string, 'watch' | 'command'>; // token: role
  invented?: { wrongRoll: boolean }; // the mock server, which says the same at every run, in any case
  dli?: string; // an endpoint that shall hear the program too
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
    const { invented, tokens } = this.options;
    this.stop =
      program === undefined || invented
        ? (await startServer({ port: this.port, web, tokens, ...invented })).close
        : await this.startDemo(program);
  }

  close(): Promise<void> {
    return this.stop();
  }

  private async startDemo(path: string): Promise<() => Promise<void>> {
    const { dli } = this.options;
    const http = ['--http', `127.0.0.1:${this.port}`, '--web-root', web];
    const demo = run(
      path,
      ['demo', '--headless', '--seconds', longEnough_s, ...http, ...(dli === undefined ? [] : ['--dli', dli])],
      this.tokenVariables(),
    );
    await demo.answers(`${this.url}healthz`);
    return demo.end;
  }

  private tokenVariables(): Record<string, string> {
    const tokens = Object.entries(this.options.tokens ?? {});
    return Object.fromEntries(tokens.map(([token, role]) => [`PONTE_HTTP_${role.toUpperCase()}_TOKEN`, token]));
  }
}

/** Starts the program; what sanitizers find in it fails the test that ends it. */
export function run(path: string, options: string[], variables: Record<string, string> = {}) {
  const child = spawn(path, [...options, '--quiet'], {
    stdio: ['ignore', 'ignore', 'pipe'],
    env: { ...process.env, ...variables },
  });
  let said = '';
  child.stderr.setEncoding('utf8').on('data', (text: string) => void (said += text));
  const gone = new Promise<void>((done) => child.once('close', () => done()));
  return {
    async answers(address: string): Promise<void> {
      for (;;) {
        if (child.exitCode !== null) throw new Error(`the program ended with status ${child.exitCode}: ${said}`);
        const answer = await fetch(address).catch(() => undefined);
        if (answer?.ok) return;
        await pause(100);
      }
    },
    async end(): Promise<void> {
      child.kill('SIGTERM');
      await gone;
      if (/Sanitizer|runtime error/.test(said)) throw new Error(said);
    },
  };
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
