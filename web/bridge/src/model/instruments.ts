import type { DliFields, DliMessage, MavlinkMessage, MavlinkValue } from '../contract';
import type { Quantity } from './units';

export const instrumentKeys = ['roll', 'pitch', 'heading', 'altitude', 'speed', 'climb', 'battery'] as const;
export type InstrumentKey = (typeof instrumentKeys)[number];

/**
 * One quantity as each side tells it, in SI units (battery: %). This table is a second opinion: it is written from the
 * protocols and does not know the mapping that it checks.
 */
export interface Instrument {
  message: string;
  fromMavlink: (fields: Record<string, MavlinkValue>) => number | undefined;
  number: number;
  fromDli: (fields: DliFields) => number | undefined;
  tolerance: number; // what the two scales may differ by
  fullCircle?: true;
  quantity: Quantity | 'percent';
}

const scaled = (name: string, factor: number) => (fields: Record<string, MavlinkValue>) => {
  const value = fields[name];
  return typeof value === 'number' ? value * factor : undefined;
};
const value = (key: string) => (fields: DliFields) => fields[key]?.value;
const negative = (key: string) => (fields: DliFields) => {
  const known = fields[key]?.value;
  return known === undefined ? undefined : -known;
};

const binaryAngleStep = Math.PI / 2 ** 15;

export const instruments: Record<InstrumentKey, Instrument> = {
  roll: {
    message: 'ATTITUDE',
    fromMavlink: scaled('roll', 1),
    number: 4000,
    fromDli: value('roll'),
    tolerance: binaryAngleStep,
    fullCircle: true,
    quantity: 'angle',
  },
  pitch: {
    message: 'ATTITUDE',
    fromMavlink: scaled('pitch', 1),
    number: 4000,
    fromDli: value('pitch'),
    tolerance: binaryAngleStep,
    fullCircle: true,
    quantity: 'angle',
  },
  heading: {
    message: 'ATTITUDE',
    fromMavlink: scaled('yaw', 1),
    number: 4000,
    fromDli: value('heading'),
    tolerance: binaryAngleStep,
    fullCircle: true,
    quantity: 'angle',
  },
  altitude: {
    message: 'GLOBAL_POSITION_INT',
    fromMavlink: scaled('alt', 1e-3),
    number: 4000,
    fromDli: value('altitude'),
    tolerance: 0.02,
    quantity: 'length',
  },
  speed: {
    message: 'GLOBAL_POSITION_INT',
    fromMavlink: (fields) =>
      typeof fields.vx === 'number' && typeof fields.vy === 'number'
        ? Math.hypot(fields.vx, fields.vy) / 100
        : undefined,
    number: 4000,
    fromDli: ({ u_speed, v_speed }) =>
      u_speed?.value === undefined || v_speed?.value === undefined
        ? undefined
        : Math.hypot(u_speed.value, v_speed.value),
    tolerance: 0.05,
    quantity: 'speed',
  },
  climb: {
    message: 'GLOBAL_POSITION_INT',
    fromMavlink: scaled('vz', -0.01),
    number: 4000,
    fromDli: negative('w_speed'),
    tolerance: 0.05,
    quantity: 'vertical speed',
  },
  battery: {
    message: 'BATTERY_STATUS',
    fromMavlink: (fields) => (fields.id === 0 ? scaled('battery_remaining', 1)(fields) : undefined),
    number: 3002,
    fromDli: value('current_propulsion_energy_level'),
    tolerance: 1,
    quantity: 'percent',
  },
};

/** What both sides say, and whether that agrees; undefined: a side has not said anything yet, or no longer does. */
export interface Reading {
  mavlink: number | undefined;
  dli: number | undefined;
  agrees: boolean | undefined;
}

/** MAVLink samples are younger or older than the DLI message by up to this. */
const window_us = 2_000_000;
/** A DLI value is told again every five seconds at the latest; an older one is of the past. */
const dliLifetime_us = 6_000_000;
/** A single comparison may meet samples that were coalesced; a wrong mapping fails every one. */
const failuresUntilDifferent = 3;

/**
 * Holds one instrument's two needles against each other. The DLI value agrees when it lies within what MAVLink said
 * during the last two seconds.
 */
export class Comparison {
  private samples: { time_us: number; value: number }[] = [];
  private failures = 0;
  private dli: { time_us: number; value: number } | undefined;

  constructor(private readonly instrument: Instrument) {}

  onMavlink(message: MavlinkMessage): void {
    if (message.name !== this.instrument.message || message.fields === undefined) return;
    const value = this.instrument.fromMavlink(message.fields);
    if (value === undefined) return;
    this.samples.push({ time_us: message.time_us, value });
    const oldest = message.time_us - window_us;
    this.samples = this.samples.filter((sample) => sample.time_us >= oldest);
  }

  onDli(message: DliMessage): void {
    if (message.number !== this.instrument.number) return;
    const value = this.instrument.fromDli({ ...message.held, ...message.fields });
    if (value === undefined) return;
    this.dli = { time_us: message.time_ms * 1000, value };
    if (this.samples.length > 0) this.failures = this.isWithinSamples(value) ? 0 : this.failures + 1;
  }

  reading(): Reading {
    const newest = this.samples.at(-1);
    const isComparable =
      newest !== undefined && this.dli !== undefined && newest.time_us - this.dli.time_us <= dliLifetime_us;
    return {
      mavlink: newest?.value,
      dli: this.dli?.value,
      agrees: isComparable ? this.failures < failuresUntilDifferent : undefined,
    };
  }

  private isWithinSamples(value: number): boolean {
    const differences = this.samples.map((sample) => this.difference(sample.value, value));
    return (
      Math.min(...differences) <= this.instrument.tolerance && Math.max(...differences) >= -this.instrument.tolerance
    );
  }

  private difference(a: number, b: number): number {
    const plain = a - b;
    return this.instrument.fullCircle ? Math.atan2(Math.sin(plain), Math.cos(plain)) : plain;
  }
}
