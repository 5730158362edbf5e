import { expect, it } from 'vitest';
import type { DliRow, MavlinkRow } from '../contract';
import { TrafficTable } from './traffic';

const row = (id: number, name: string, system: number, count: number, instance?: number): MavlinkRow =>
  ({
    count,
    rate_hz: 1,
    last: {
      link: 1,
      system,
      component: 1,
      id,
      name,
      fields: { roll: 1 },
      ...(instance !== undefined && { instance: { field: 'id', value: instance } }),
    },
  }) as unknown as MavlinkRow;
const nothing = { kind: 'traffic' as const, mavlink: [], dli: [], senders: [], rejects: [] };

it('keeps one row for each sender, message and instance, the newest', () => {
  const table = new TrafficTable();
  table.add({
    ...nothing,
    mavlink: [row(147, 'BATTERY_STATUS', 1, 1, 0), row(147, 'BATTERY_STATUS', 1, 1, 1), row(30, 'ATTITUDE', 2, 1)],
  });
  table.add({ ...nothing, mavlink: [row(30, 'ATTITUDE', 1, 5), row(30, 'ATTITUDE', 2, 9)] });
  expect(table.mavlink('').map(({ last, count }) => [last.system, last.name, last.instance?.value, count])).toEqual([
    [1, 'ATTITUDE', undefined, 5],
    [1, 'BATTERY_STATUS', 0, 1],
    [1, 'BATTERY_STATUS', 1, 1],
    [2, 'ATTITUDE', undefined, 9],
  ]);
});

it('filters by every word, over name, number, sender and fields', () => {
  const table = new TrafficTable();
  table.add({ ...nothing, mavlink: [row(30, 'ATTITUDE', 1, 1), row(30, 'ATTITUDE', 2, 1), row(0, 'HEARTBEAT', 2, 1)] });
  const found = (filter: string) => table.mavlink(filter).map(({ last }) => `${last.name} ${last.system}`);
  expect(found('att')).toEqual(['ATTITUDE 1', 'ATTITUDE 2']);
  expect(found('ATT 1/2/1')).toEqual(['ATTITUDE 2']);
  expect(found('roll heart')).toEqual(['HEARTBEAT 2']);
  expect(found('no such thing')).toEqual([]);
});

it('finds a DLI message by a field that is held', () => {
  const table = new TrafficTable();
  const last = { source: '14:40:00:01', number: 4000, name: 'Inertial States', fields: {}, held: { roll: { raw: 1 } } };
  table.add({ ...nothing, dli: [{ count: 1, rate_hz: 1, last } as unknown as DliRow] });
  expect(table.dli('#4000 roll')).toHaveLength(1);
});

it('puts the commonest reason for rejection first', () => {
  const table = new TrafficTable();
  const reject = (reason: string, count: number) => ({
    side: 'mavlink' as const,
    link: 1,
    reason,
    count,
    bytes: count,
  });
  table.add({ ...nothing, rejects: [reject('noise', 2), reject('bad checksum', 7)] });
  expect(table.rejects().map(({ reason }) => reason)).toEqual(['bad checksum', 'noise']);
});
