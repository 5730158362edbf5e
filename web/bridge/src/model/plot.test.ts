import { expect, it } from 'vitest';
import type { DliMessage, MavlinkMessage } from '../contract';
import { Plot } from './plot';

const battery = (id: number, time_us: number, voltages: (number | string)[]): MavlinkMessage => ({
  link: 1,
  time_us,
  id: 147,
  name: 'BATTERY_STATUS',
  version: 2,
  system: 1,
  component: 1,
  sequence: 0,
  instance: { field: 'id', value: id },
  fields: { id, voltages },
  hex: '',
});

it('follows one element of an array of one instance', () => {
  const plot = new Plot({ side: 'mavlink', sample: battery(0, 0, []), field: 'voltages', element: 1 });
  plot.onMavlink(battery(0, 1_000_000, [4000, 3900]));
  plot.onMavlink(battery(1, 1_500_000, [1, 2]));
  plot.onMavlink(battery(0, 2_000_000, [4000, 3890]));
  expect(plot.series.times).toEqual([1, 2]);
  expect(plot.series.values).toEqual([3900, 3890]);
});

it('leaves a gap where a value is no number, and takes a message that comes twice once', () => {
  const plot = new Plot({ side: 'mavlink', sample: battery(0, 0, []), field: 'voltages', element: 0 });
  plot.onMavlink(battery(0, 1_000_000, ['NaN']));
  plot.onMavlink(battery(0, 1_000_000, [4000]));
  expect(plot.series.values).toEqual([null]);
});

it('takes a DLI field that did not change from the held ones', () => {
  const plot = new Plot({ side: 'dli', source: '14:40:00:01', number: 4000, field: 'roll' });
  const message = (time_ms: number, fields: DliMessage['fields'], held: DliMessage['fields']) =>
    ({ time_ms, number: 4000, source: '14:40:00:01', fields, held }) as DliMessage;
  plot.onDli(message(1000, { roll: { raw: 1820, value: 0.17449, unit: 'rad' } }, {}));
  plot.onDli(message(2000, {}, { roll: { raw: 1820, value: 0.17449, unit: 'rad' } }));
  expect(plot.series.values).toEqual([0.17449, 0.17449]);
});
