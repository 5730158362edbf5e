import { expect, it } from 'vitest';
import type { Crossing, DliMessage, MavlinkMessage } from '../contract';
import { Crossings } from './crossings';

const mavlink = (name: string, id: number, instance?: number) =>
  ({
    link: 1,
    system: 1,
    component: 1,
    id,
    name,
    time_us: 1e6,
    fields: {},
    ...(instance !== undefined && { instance: { field: 'id', value: instance } }),
  }) as unknown as MavlinkMessage;
const dli = (number: number) => ({ number, name: `Message ${number}`, fields: {}, held: {} }) as unknown as DliMessage;
const titles = (crossings: Crossings) => crossings.flows().map(({ title }) => title);

it('lists what is translated first, then the rest, then what the clock sends', () => {
  const crossings = new Crossings();
  crossings.add([
    { number: 1, dli: [dli(16002)] },
    { number: 2, mavlink: mavlink('VFR_HUD', 74), dli: [] },
    { number: 3, mavlink: mavlink('ATTITUDE', 30), dli: [dli(4000)] },
  ]);
  expect(titles(crossings)).toEqual(['ATTITUDE', 'VFR_HUD', '#16002 Message 16002']);
});

it('keeps the place of a message that brings no news for once', () => {
  const crossings = new Crossings();
  crossings.add([{ number: 1, mavlink: mavlink('ATTITUDE', 30), dli: [dli(4000)] }]);
  crossings.add([{ number: 2, mavlink: mavlink('ATTITUDE', 30), dli: [] }]);
  expect(crossings.flows()[0]).toMatchObject({ title: 'ATTITUDE', numbers: [4000], crossing: { number: 2 } });
  expect(crossings.newestDli(4000)).toBeDefined();
});

it('tells the instances of a message apart', () => {
  const crossings = new Crossings();
  crossings.add(
    [0, 1].map((instance) => ({ number: instance, mavlink: mavlink('BATTERY_STATUS', 147, instance), dli: [] })),
  );
  expect(titles(crossings)).toEqual(['BATTERY_STATUS 0', 'BATTERY_STATUS 1']);
});

it('takes crossings in the order in which they happened', () => {
  const crossings = new Crossings();
  const attitude = (number: number): Crossing => ({ number, mavlink: mavlink('ATTITUDE', 30), dli: [] });
  crossings.add([attitude(8), attitude(7)]);
  expect(crossings.flows()[0]!.crossing.number).toBe(8);
});
