// What a vehicle says, step by step, and what becomes of it: the same at every run.
import { dliMessage, mavlinkHex, rawOf } from './encode.mjs';

export const stepsPerSecond = 20;
const start_ms = Date.UTC(2026, 0, 1, 12);
const dliEpoch_ms = Date.UTC(2000, 0, 1);
const component = 1;
/** A float as programs print it: the digits that tell it from its neighbours. */
const float = (value) => Number(Math.fround(value).toPrecision(8));

/** One vehicle on its circle. `mapRoll` may be wrong on purpose, to see the page notice it. */
export class Flight {
  constructor({ link, system, id, mapRoll = ({ roll }) => roll }) {
    Object.assign(this, { link, system, id, mapRoll });
    this.sequence = 0;
    this.held = {};
  }

  /** The crossings of a step; `convert` says whether they become DLI messages. */
  step(step, convert, nextNumber) {
    const said = this.said(step);
    const crossings = [];
    const add = (name, id, fields, messages = [], instance) => {
      const mavlink = this.mavlink(step, name, id, fields, instance);
      const translated = convert ? messages.filter((message) => message !== undefined) : [];
      // Stage times that vary, the same at every run; every hundredth message is slow.
      const base = 20_000 + ((step * 7919 + id * 104_729) % 30_000) + (step % 100 === 99 ? 2_000_000 : 0);
      const stages_ns = {
        decoded: Math.round(base / 8),
        ...(translated.length > 0 && { translated: Math.round(base / 2), sent: base }),
      };
      crossings.push({ number: nextNumber(), mavlink, stages_ns, dli: translated });
    };
    if (step % 2 === 1) add('GLOBAL_POSITION_INT', 33, said.position);
    add('ATTITUDE', 30, said.attitude, [this.inertialStates(step, said)]);
    if (step % 5 === 0) add('VFR_HUD', 74, said.hud);
    if (step % 10 === 0) {
      add('BATTERY_STATUS', 147, said.battery(0), [this.operatingStates(step, said)], { field: 'id', value: 0 });
      add('BATTERY_STATUS', 147, said.battery(1), [], { field: 'id', value: 1 });
    }
    if (step % 20 === 0) {
      add('HEARTBEAT', 0, said.heartbeat);
      crossings.push({ number: nextNumber(), dli: convert ? [this.dli(step, 16002, {})] : [] });
    }
    if (step % 200 === 40) add('STATUSTEXT', 253, { severity: 6, text: 'Mission: 3 WP' }, [this.alert(step)]);
    return crossings.filter(({ mavlink, dli }) => mavlink !== undefined || dli.length > 0);
  }

  said(step) {
    const t = step / stepsPerSecond + this.system;
    const roll = 0.3 * Math.sin(t / 2);
    const pitch = 0.12 * Math.sin(t / 3);
    const yaw = ((t / 10) % (2 * Math.PI)) - Math.PI;
    const alt = 120 + 20 * Math.sin(t / 15);
    const climb = (20 / 15) * Math.cos(t / 15);
    const time_boot_ms = Math.round(t * 1000);
    const [vx, vy] = [12 * Math.cos(yaw), 12 * Math.sin(yaw)];
    return {
      t,
      roll,
      pitch,
      yaw,
      heartbeat: { type: 2, autopilot: 3, base_mode: 137, custom_mode: 3, system_status: 4, mavlink_version: 3 },
      attitude: {
        time_boot_ms,
        roll: float(roll),
        pitch: float(pitch),
        yaw: float(yaw),
        rollspeed: float(0.15 * Math.cos(t / 2)),
        pitchspeed: float(0.04 * Math.cos(t / 3)),
        yawspeed: float(0.1),
      },
      position: {
        time_boot_ms,
        lat: 386_975_000 + Math.round(9000 * Math.sin(t / 20)),
        lon: -94_215_000 + Math.round(9000 * Math.cos(t / 20)),
        alt: Math.round(alt * 1000),
        relative_alt: Math.round(alt * 1000) - 35_000,
        vx: Math.round(vx * 100),
        vy: Math.round(vy * 100),
        vz: Math.round(-climb * 100),
        hdg: Math.round(((yaw * 18_000) / Math.PI + 36_000) % 36_000),
      },
      hud: {
        airspeed: 13,
        groundspeed: 12,
        heading: Math.round((yaw * 180) / Math.PI + 360) % 360,
        throttle: 41,
        alt: float(alt),
        climb: float(climb),
      },
      battery: (id) => ({
        id,
        battery_function: 0,
        type: 1,
        temperature: 3150,
        voltages: [
          ...Array.from({ length: 4 }, (_, cell) => 3900 - Math.floor(t) - 3 * cell),
          ...Array(6).fill(65_535),
        ],
        current_battery: 1240 + Math.round(30 * Math.sin(t)),
        current_consumed: 300 + Math.round(t),
        energy_consumed: -1,
        battery_remaining: Math.max(5, 87 - Math.floor(t / 60)),
      }),
    };
  }

  time_ms(step) {
    return start_ms + (step * 1000) / stepsPerSecond;
  }

  mavlink(step, name, id, fields, instance) {
    this.sequence = (this.sequence + 1) % 256;
    const head = { system: this.system, component, sequence: this.sequence };
    return {
      link: this.link,
      time_us: this.time_ms(step) * 1000,
      id,
      name,
      version: 2,
      ...head,
      ...(instance && { instance }),
      fields,
      hex: mavlinkHex({ id, ...head, fields }),
    };
  }

  /** A message with the fields whose raw values are news; the others are held. */
  dli(step, number, raws, labels) {
    const before = (this.held[number] ??= {});
    const news = Object.fromEntries(Object.entries(raws).filter(([key, raw]) => before[key] !== raw));
    const held = Object.fromEntries(
      Object.entries(before).filter(([key]) => news[key] === undefined && key !== 'time_stamp'),
    );
    const time_ms = this.time_ms(step);
    const sent = { time_stamp: time_ms - dliEpoch_ms, ...news };
    this.held[number] = { ...before, ...sent };
    return dliMessage({ number, time_ms, source: this.id, raws: sent, held, labels });
  }

  inertialStates(step, said) {
    const { attitude, position } = said;
    const raw = (key, value) => rawOf(4000, key, value);
    const moved = step % 2 === 1 || this.held[4000] === undefined;
    const radians = (degE7) => (degE7 * Math.PI) / 180e7;
    return this.dli(
      step,
      4000,
      {
        ...(moved && {
          latitude: raw('latitude', radians(position.lat)),
          longitude: raw('longitude', radians(position.lon)),
          altitude: raw('altitude', position.alt / 1000),
          altitude_type: 3,
          u_speed: raw('u_speed', position.vx / 100),
          v_speed: raw('v_speed', position.vy / 100),
          w_speed: raw('w_speed', position.vz / 100),
        }),
        roll: raw('roll', this.mapRoll(attitude)),
        pitch: raw('pitch', attitude.pitch),
        heading: raw('heading', attitude.yaw),
        roll_rate: raw('roll_rate', attitude.rollspeed),
        pitch_rate: raw('pitch_rate', attitude.pitchspeed),
      },
      { altitude_type: 'WGS-84' },
    );
  }

  operatingStates(step, said) {
    return this.dli(step, 3002, {
      current_propulsion_energy_level: rawOf(
        3002,
        'current_propulsion_energy_level',
        said.battery(0).battery_remaining,
      ),
      av_state: 11,
    });
  }

  alert(step) {
    return this.dli(
      step,
      16000,
      { priority: 1, subsystem_id: 9, type: 3, alert_id: step, text: 'Mission: 3 WP', persistence: 10 },
      { priority: 'Nominal' },
    );
  }
}
