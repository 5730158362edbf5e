import { expect, it } from 'vitest';
import { catalogue as data } from '../../test/mock/catalogue.mjs';
import type { CatalogueData, MavlinkFieldInfo } from '../contract';
import { Catalogue } from './catalogue';

const catalogue = new Catalogue(data as CatalogueData);

it('follows a DLI field back to what it comes from', () => {
  const [chain] = catalogue.chainsOf(4000, 'roll');
  expect(chain).toMatchObject({
    toDli: { rule: "as is, in the field's scale", confidence: 'standard' },
    fromMavlink: [{ message: 'ATTITUDE', sources: ['roll'], fact: 'roll' }],
  });
});

it('follows a MAVLink field to those that it leads, not to those where it only helps', () => {
  const targets = (field: string) => catalogue.targetsOf('ATTITUDE', field).map((rule) => rule.field);
  expect(targets('roll')).toEqual(['roll']);
  expect(targets('yawspeed')).toEqual(['roll_rate', 'pitch_rate']);
  expect(targets('time_boot_ms')).toEqual([]);
});

it('knows which DLI messages carry what a MAVLink message says', () => {
  expect(catalogue.numbersFrom('GLOBAL_POSITION_INT')).toEqual([4000]);
  expect(catalogue.numbersFrom('VFR_HUD')).toEqual([]);
});

it('labels enumerations and flags', () => {
  const field = (name: string) =>
    catalogue.mavlink({ id: 0, version: 2 })!.fields.find((info: MavlinkFieldInfo) => info.name === name)!;
  expect(catalogue.labelOf(field('type'), 2)).toBe('MAV_TYPE_QUADROTOR');
  expect(catalogue.labelOf(field('type'), 200)).toBeUndefined();
  expect(catalogue.labelOf(field('base_mode'), 137)).toBe(
    'MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | MAV_MODE_FLAG_GUIDED_ENABLED | MAV_MODE_FLAG_SAFETY_ARMED',
  );
});

it('keeps what it knows of today off the messages of MAVLink 0.9', () => {
  expect(catalogue.mavlink({ id: 0, version: 1 })).toBeDefined();
  expect(catalogue.mavlink({ id: 0, version: 0.9 })).toBeUndefined();
});
