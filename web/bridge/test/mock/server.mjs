// A server that follows web/contract, for the tests of the page: no part of the product.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { WebSocketServer } from 'ws';
import { Bridge } from './bridge.mjs';
import { catalogue } from './catalogue.mjs';
import { stepsPerSecond } from './flight.mjs';
import { check } from './validate.mjs';

const types = {
  '.html': 'text/html; charset=utf-8',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
};
const securityHeaders = {
  'X-Content-Type-Options': 'nosniff',
  'Referrer-Policy': 'no-referrer',
  'Content-Security-Policy':
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
};

class Problem extends Error {
  constructor(status, code, detail) {
    super(detail);
    Object.assign(this, { status, body: { code, detail } });
  }
}

/** Options: `port`, `web` (the built page), `vehicles`, `wrongRoll`, `tokens` ({token: role}; empty: everybody may). */
export function startServer({ port, web, vehicles = 2, wrongRoll = false, tokens = {} }) {
  const bridge = new Bridge({ vehicles, wrongRoll });
  const sessions = new Map();
  const clients = new Set();

  const send = (client, message) => {
    check.fromServer(message);
    client.socket.send(JSON.stringify(message));
  };
  const sendAll = (message) => clients.forEach((client) => send(client, message));
  bridge.onEvent = (event) => sendAll({ kind: 'events', events: [event] });

  const sessionOf = ({ headers }) => sessions.get(/ponte_session=(\w+)/.exec(headers.cookie ?? '')?.[1]);
  const roleOf = (request) => (Object.keys(tokens).length === 0 ? 'command' : sessionOf(request));
  const examine = (request) => {
    const { origin, host } = request.headers;
    if (origin !== undefined && new URL(origin).host !== host)
      throw new Problem(403, 'foreign_origin', `${origin} may not use this server`);
    if (request.url === '/api/v1/session') return;
    const role = roleOf(request);
    if (role === undefined) throw new Problem(401, 'no_session', 'exchange a token for a session first');
    if (role === 'watch' && request.method !== 'GET')
      throw new Problem(403, 'watch_only', 'this needs a command token');
  };

  const json = (status, value, headers) => ({
    status,
    body: JSON.stringify(value),
    headers: { 'Content-Type': 'application/json', ...headers },
  });
  const routes = {
    'POST session': ({ token }) => {
      const role = tokens[token];
      if (role === undefined) throw new Problem(401, 'wrong_token', 'the server does not know this token');
      const session = `s${sessions.size + 1}`;
      sessions.set(session, role);
      check.session({ role });
      return json(200, { role }, { 'Set-Cookie': `ponte_session=${session}; HttpOnly; SameSite=Strict; Path=/` });
    },
    'DELETE session': () => ({ status: 204, headers: { 'Set-Cookie': 'ponte_session=; Max-Age=0; Path=/' } }),
    'GET status': () => json(200, bridge.status()),
    'GET catalogue': () => {
      check.catalogue(catalogue);
      return json(200, catalogue, { ETag: '"mock"' });
    },
    'GET ports': () =>
      json(200, [
        { device: '/dev/ttyACM0', by_id: '/dev/serial/by-id/usb-Mock', autopilot: true },
        { device: '/dev/ttyS0', by_id: '', autopilot: false },
      ]),
    'POST vehicle-links': ({ endpoint }) => {
      if (!/^(serial|udpin|udpout|tcpin|tcpout|udpmulticast|file):\/\/.+/.test(endpoint))
        throw new Problem(400, 'bad_endpoint', `'${endpoint}': expected a scheme such as serial:// or udpin://`);
      return json(201, bridge.connect(endpoint));
    },
    'PUT conversion': ({ on }) => {
      bridge.convert(on);
      return { status: 204 };
    },
    'POST latency-study': ({ samples, limit_ms }) => {
      if (bridge.study.state === 'running') throw new Problem(409, 'busy', 'a study is running already');
      bridge.startStudy(samples, limit_ms);
      return { status: 202 };
    },
    'DELETE latency-study': () => {
      bridge.stopStudy();
      return { status: 204 };
    },
    'GET latency-study/result': (_, { searchParams }) => {
      if (bridge.study.state !== 'done') throw new Problem(404, 'not_found', 'no study has finished yet');
      const result = bridge.studyResult();
      check.studyResult(result);
      const format = searchParams.get('format') ?? 'json';
      if (format === 'json') return json(200, result);
      return {
        status: 200,
        body: `study as ${format}\n`,
        headers: {
          'Content-Type': `text/${format}`,
          'Content-Disposition': `attachment; filename=ponte-latency.${format}`,
        },
      };
    },
  };

  async function answer(request) {
    const url = new URL(request.url, `http://${request.headers.host}`);
    if (url.pathname === '/healthz') return { status: 200, body: 'ok\n', headers: { 'Content-Type': 'text/plain' } };
    if (!url.pathname.startsWith('/api/v1/')) return file(url.pathname);
    examine(request);
    const path = url.pathname.slice('/api/v1/'.length);
    const link = /^vehicle-links\/(\d+)$/.exec(path);
    if (link && request.method === 'DELETE') {
      if (bridge.disconnect(Number(link[1]))) return { status: 204 };
      throw new Problem(404, 'not_found', `there is no link ${link[1]}`);
    }
    const route = routes[`${request.method} ${path}`];
    if (route === undefined)
      throw new Problem(404, 'not_found', `${request.method} ${url.pathname} is not of this server`);
    const chunks = [];
    for await (const chunk of request) chunks.push(chunk);
    const text = Buffer.concat(chunks).toString();
    return route(text === '' ? {} : JSON.parse(text), url);
  }

  async function file(path) {
    const name = normalize(path === '/' ? '/index.html' : path);
    try {
      return {
        status: 200,
        body: await readFile(join(web, name)),
        headers: { 'Content-Type': types[extname(name)] ?? 'application/octet-stream' },
      };
    } catch {
      throw new Problem(404, 'not_found', `there is no ${name}`);
    }
  }

  function problemOf(error) {
    if (!(error instanceof Problem)) throw error;
    check.problem(error.body);
    return json(error.status, error.body);
  }

  const server = createServer((request, response) => {
    void answer(request)
      .catch(problemOf)
      .then(({ status, body, headers }) => response.writeHead(status, { ...securityHeaders, ...headers }).end(body));
  });

  const sockets = new WebSocketServer({ noServer: true, maxPayload: 1024 });
  server.on('upgrade', (request, socket, head) => {
    try {
      examine(request);
    } catch (error) {
      const { status, body } = problemOf(error);
      return socket.end(
        `HTTP/1.1 ${status} Refused\r\nContent-Length: ${body.length}\r\nConnection: close\r\n\r\n${body}`,
      );
    }
    sockets.handleUpgrade(request, socket, head, (webSocket) => welcome(webSocket, request));
  });

  function welcome(socket, request) {
    const client = { socket, wanted: { vehicle: null, traffic: false } };
    socket.on('message', (data) => {
      const message = JSON.parse(String(data));
      check.fromClient(message);
      client.wanted = message;
    });
    socket.on('close', () => clients.delete(client));
    send(client, { kind: 'hello', version: 'mock', role: roleOf(request), session: Object.keys(tokens).length > 0 });
    send(client, bridge.status());
    send(client, { kind: 'events', events: bridge.events.slice(-200) });
    send(client, bridge.study);
    send(client, bridge.timing());
    clients.add(client);
  }

  let study = bridge.study;
  let conversion = bridge.conversion;
  let links = bridge.links.length;
  function tick() {
    const crossings = bridge.step();
    for (const client of clients) {
      const own = crossings.get(client.wanted.vehicle) ?? [];
      if (own.length > 0) send(client, { kind: 'crossings', crossings: own });
      if (client.wanted.traffic && bridge.stepNumber % (stepsPerSecond / 2) === 0) send(client, bridge.traffic());
    }
    const hasChanged = conversion !== bridge.conversion || links !== bridge.links.length;
    if (hasChanged || bridge.stepNumber % stepsPerSecond === 0) sendAll(bridge.status());
    if (bridge.stepNumber % stepsPerSecond === 0) sendAll(bridge.timing());
    if (study !== bridge.study) sendAll(bridge.study);
    study = bridge.study;
    conversion = bridge.conversion;
    links = bridge.links.length;
  }
  const timer = setInterval(tick, 1000 / stepsPerSecond);

  return new Promise((resolve, reject) => {
    server.on('error', reject);
    server.listen(port, '127.0.0.1', () =>
      resolve({
        port: server.address().port,
        async close() {
          clearInterval(timer);
          clients.forEach(({ socket }) => socket.terminate());
          server.closeAllConnections();
          await new Promise((closed) => server.close(closed));
        },
      }),
    );
  });
}
