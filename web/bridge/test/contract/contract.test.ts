import { readFileSync } from 'node:fs';
import { expect, it } from 'vitest';
import { parse } from 'yaml';
import { Bridge } from '../mock/bridge.mjs';
import { catalogue } from '../mock/catalogue.mjs';
import { check } from '../mock/validate.mjs';

const openApi = parse(readFileSync(new URL('../../../contract/openapi.yaml', import.meta.url), 'utf8'));

it('holds what the mock server says during a minute', () => {
  const bridge = new Bridge({ vehicles: 2, wrongRoll: false });
  bridge.startStudy(30, 500);
  for (let step = 0; step < 1200; ++step)
    for (const crossings of bridge.step().values()) check.fromServer({ kind: 'crossings', crossings });
  for (const message of [bridge.status(), bridge.traffic(), bridge.timing(), bridge.study]) check.fromServer(message);
  check.fromServer({ kind: 'events', events: bridge.events });
  check.studyResult(bridge.studyResult());
  check.catalogue(catalogue);
});

it('refuses what it does not have', () => {
  expect(() => check.fromServer({ kind: 'dropped', count: -1 })).toThrow('must be >= 0');
  expect(() => check.fromServer({ kind: 'dropped', count: 1, why: '' })).toThrow('additional properties');
  expect(() => check.fromServer({ kind: 'news' })).toThrow();
  expect(() => check.fromClient({ kind: 'watch', vehicle: 'x', traffic: true })).toThrow('pattern');
});

it('needs stage times wherever there is a MAVLink message', () => {
  const bridge = new Bridge({ vehicles: 1, wrongRoll: false });
  const [crossing] = [...bridge.step().values()][0]!;
  const { stages_ns, ...without } = crossing!;
  expect(stages_ns).toBeDefined();
  expect(() => check.fromServer({ kind: 'crossings', crossings: [without] })).toThrow('stages_ns');
});

it('has only references that lead somewhere', () => {
  const references: string[] = JSON.stringify(openApi).match(/#\/components\/[^"]+/g) ?? [];
  expect(references.length).toBeGreaterThan(20);
  for (const reference of references) {
    const target = reference
      .slice(2)
      .split('/')
      .reduce((at, key) => at?.[key], openApi);
    expect(target, reference).toBeDefined();
  }
});
