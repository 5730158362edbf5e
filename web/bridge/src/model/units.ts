export const unitSystems = ['si', 'aviation', 'nautical'] as const;
export type UnitSystem = (typeof unitSystems)[number];

export type Quantity =
  | 'angle'
  | 'angular rate'
  | 'length'
  | 'speed'
  | 'vertical speed'
  | 'acceleration'
  | 'temperature'
  | 'pressure'
  | 'voltage'
  | 'current';

/** A value with the unit that it is shown in. */
export interface Shown {
  value: number;
  unit: string;
  decimals: number;
}

interface Unit {
  unit: string;
  perSi: number; // of this unit in one SI unit
  offset?: number; // added after that
  decimals: number;
}

const degree = Math.PI / 180;
const foot = 0.3048;
const knot = 1852 / 3600;
const gravity = 9.80665;
const celsiusZero = 273.15;

/** The units of the protocols: what they measure, and the SI value of one. */
const wireUnits: Record<string, { quantity: Quantity; si: number; offset?: number }> = {
  rad: { quantity: 'angle', si: 1 },
  mrad: { quantity: 'angle', si: 1e-3 },
  deg: { quantity: 'angle', si: degree },
  cdeg: { quantity: 'angle', si: degree / 100 },
  degE5: { quantity: 'angle', si: degree / 1e5 },
  degE7: { quantity: 'angle', si: degree / 1e7 },
  'rad/s': { quantity: 'angular rate', si: 1 },
  'mrad/s': { quantity: 'angular rate', si: 1e-3 },
  'deg/s': { quantity: 'angular rate', si: degree },
  'cdeg/s': { quantity: 'angular rate', si: degree / 100 },
  km: { quantity: 'length', si: 1000 },
  m: { quantity: 'length', si: 1 },
  dm: { quantity: 'length', si: 0.1 },
  cm: { quantity: 'length', si: 0.01 },
  mm: { quantity: 'length', si: 0.001 },
  'm/s': { quantity: 'speed', si: 1 },
  'dm/s': { quantity: 'speed', si: 0.1 },
  'cm/s': { quantity: 'speed', si: 0.01 },
  'mm/s': { quantity: 'speed', si: 0.001 },
  'm/s/s': { quantity: 'acceleration', si: 1 },
  'm/s^2': { quantity: 'acceleration', si: 1 },
  mG: { quantity: 'acceleration', si: gravity / 1000 },
  K: { quantity: 'temperature', si: 1 },
  degC: { quantity: 'temperature', si: 1, offset: celsiusZero },
  cdegC: { quantity: 'temperature', si: 0.01, offset: celsiusZero },
  Pa: { quantity: 'pressure', si: 1 },
  hPa: { quantity: 'pressure', si: 100 },
  V: { quantity: 'voltage', si: 1 },
  cV: { quantity: 'voltage', si: 0.01 },
  mV: { quantity: 'voltage', si: 0.001 },
  A: { quantity: 'current', si: 1 },
  cA: { quantity: 'current', si: 0.01 },
  mA: { quantity: 'current', si: 0.001 },
};

const si: Record<Quantity, Unit> = {
  angle: { unit: 'rad', perSi: 1, decimals: 4 },
  'angular rate': { unit: 'rad/s', perSi: 1, decimals: 4 },
  length: { unit: 'm', perSi: 1, decimals: 2 },
  speed: { unit: 'm/s', perSi: 1, decimals: 2 },
  'vertical speed': { unit: 'm/s', perSi: 1, decimals: 2 },
  acceleration: { unit: 'm/s²', perSi: 1, decimals: 3 },
  temperature: { unit: 'K', perSi: 1, decimals: 2 },
  pressure: { unit: 'Pa', perSi: 1, decimals: 0 },
  voltage: { unit: 'V', perSi: 1, decimals: 3 },
  current: { unit: 'A', perSi: 1, decimals: 2 },
};

// What people at instruments read, in the air and at sea.
const practical: Partial<Record<Quantity, Unit>> = {
  angle: { unit: '°', perSi: 1 / degree, decimals: 2 },
  'angular rate': { unit: '°/s', perSi: 1 / degree, decimals: 2 },
  speed: { unit: 'kn', perSi: 1 / knot, decimals: 1 },
  temperature: { unit: '°C', perSi: 1, offset: -celsiusZero, decimals: 1 },
  pressure: { unit: 'hPa', perSi: 0.01, decimals: 1 },
};

const shownUnits: Record<UnitSystem, Record<Quantity, Unit>> = {
  si,
  aviation: {
    ...si,
    ...practical,
    length: { unit: 'ft', perSi: 1 / foot, decimals: 0 },
    'vertical speed': { unit: 'ft/min', perSi: 60 / foot, decimals: 0 },
  },
  nautical: { ...si, ...practical },
};

/** An SI value as the unit system shows it. */
export function shown(quantity: Quantity, value: number, system: UnitSystem): Shown {
  const { unit, perSi, offset = 0, decimals } = shownUnits[system][quantity];
  return { value: value * perSi + offset, unit, decimals };
}

/** A value in a protocol's unit as the unit system shows it; nothing where the unit is none that can be converted. */
export function shownFromWire(value: number, wireUnit: string | undefined, system: UnitSystem): Shown | undefined {
  const wire = wireUnit === undefined ? undefined : wireUnits[wireUnit];
  if (wire === undefined) return undefined;
  return shown(wire.quantity, value * wire.si + (wire.offset ?? 0), system);
}

/** Angles as instruments show them, in degrees whatever the unit system. */
export function degrees(radians: number): number {
  return radians / degree;
}
