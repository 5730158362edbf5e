import { describe, expect, it } from 'vitest';
import type { DliFields, DliMessage, MavlinkMessage, MavlinkValue } from '../contract';
import { Comparison, instruments } from './instruments';

const attitude = (seconds: number, fields: Record<string, MavlinkValue>) =>
  ({ name: 'ATTITUDE', time_us: seconds * 1e6, fields }) as MavlinkMessage;
const inertialStates = (seconds: number, fields: DliFields, held: DliFields = {}) =>
  ({ number: 4000, time_ms: seconds * 1e3, fields, held }) as DliMessage;
const radians = (value: number): DliFields[string] => ({
  raw: Math.round((value / Math.PI) * 32768),
  value,
  unit: 'rad',
});

describe('Comparison', () => {
  it('waits until both sides have spoken', () => {
    const roll = new Comparison(instruments.roll);
    roll.onMavlink(attitude(1, { roll: 0.1 }));
    expect(roll.reading()).toEqual({ mavlink: 0.1, dli: undefined, agrees: undefined });
  });

  it('agrees within the step of the binary angle', () => {
    const roll = new Comparison(instruments.roll);
    roll.onMavlink(attitude(1, { roll: 0.1 }));
    roll.onDli(inertialStates(1, { roll: radians(0.10005) }));
    expect(roll.reading().agrees).toBe(true);
  });

  it('agrees with a value that MAVLink told a moment ago', () => {
    const roll = new Comparison(instruments.roll);
    for (const [seconds, value] of [
      [1, 0.1],
      [1.1, 0.2],
      [1.2, 0.3],
    ] as const)
      roll.onMavlink(attitude(seconds, { roll: value }));
    roll.onDli(inertialStates(1.2, { roll: radians(0.15) }));
    expect(roll.reading().agrees).toBe(true);
  });

  it('notices yaw where roll belongs, at the third message', () => {
    const roll = new Comparison(instruments.roll);
    const verdicts = [1, 2, 3].map((seconds) => {
      roll.onMavlink(attitude(seconds, { roll: 0.1, yaw: 1.5 }));
      roll.onDli(inertialStates(seconds, { roll: radians(1.5) }));
      return roll.reading().agrees;
    });
    expect(verdicts).toEqual([true, true, false]);
  });

  it('takes both ends of the circle for neighbours', () => {
    const heading = new Comparison(instruments.heading);
    for (const seconds of [1, 2, 3]) {
      heading.onMavlink(attitude(seconds, { yaw: 3.14155 }));
      heading.onDli(inertialStates(seconds, { heading: radians(-3.14159) }));
    }
    expect(heading.reading().agrees).toBe(true);
  });

  it('uses the held value of a field that did not change', () => {
    const roll = new Comparison(instruments.roll);
    roll.onMavlink(attitude(1, { roll: 0.1 }));
    roll.onDli(inertialStates(1, {}, { roll: radians(0.1) }));
    expect(roll.reading()).toMatchObject({ dli: 0.1, agrees: true });
  });

  it('has no verdict once the DLI has fallen silent', () => {
    const roll = new Comparison(instruments.roll);
    roll.onMavlink(attitude(1, { roll: 0.1 }));
    roll.onDli(inertialStates(1, { roll: radians(0.1) }));
    roll.onMavlink(attitude(8, { roll: 0.1 }));
    expect(roll.reading()).toMatchObject({ dli: 0.1, agrees: undefined });
  });
});

describe('instruments', () => {
  it('turn both sides into the same speed and climb', () => {
    const position = { vx: 300, vy: -400, vz: -120, alt: 50_090 };
    const states: DliFields = {
      u_speed: { raw: 60, value: 3, unit: 'm/s' },
      v_speed: { raw: -80, value: -4, unit: 'm/s' },
      w_speed: { raw: -24, value: -1.2, unit: 'm/s' },
    };
    expect(instruments.speed.fromMavlink(position)).toBe(5);
    expect(instruments.speed.fromDli(states)).toBe(5);
    expect(instruments.climb.fromMavlink(position)).toBeCloseTo(1.2);
    expect(instruments.climb.fromDli(states)).toBe(1.2);
    expect(instruments.altitude.fromMavlink(position)).toBeCloseTo(50.09);
  });

  it('take the first battery only, as the vehicle has one energy level', () => {
    expect(instruments.battery.fromMavlink({ id: 0, battery_remaining: 87 })).toBe(87);
    expect(instruments.battery.fromMavlink({ id: 1, battery_remaining: 12 })).toBeUndefined();
  });
});
