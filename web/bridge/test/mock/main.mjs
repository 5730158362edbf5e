// Runs the mock server by hand: npm run mock -- [--port 8586] [--vehicles 2] [--wrong-roll]
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { startServer } from './server.mjs';

const { values } = parseArgs({
  options: {
    port: { type: 'string', default: '8586' },
    vehicles: { type: 'string', default: '2' },
    'wrong-roll': { type: 'boolean', default: false },
  },
});
const web = fileURLToPath(new URL('../../../../build/web/bridge', import.meta.url));
const { port } = await startServer({
  port: Number(values.port),
  web,
  vehicles: Number(values.vehicles),
  wrongRoll: values['wrong-roll'],
});
console.log(`the page, with invented data, is at http://127.0.0.1:${port}/`);
