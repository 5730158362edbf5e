// The state behind the mock server: vehicles, links, counters, events, the study.
import { Flight, stepsPerSecond } from './flight.mjs';

const bounds_ns = [10_000, 20_000, 50_000, 100_000, 200_000, 500_000, 1_000_000, 2_000_000, 5_000_000, 10_000_000];
const studySamplesPerStep = 2;
const start_us = Date.UTC(2026, 0, 1, 12) * 1000;

function summaryOf(series) {
  const sorted = [...series].sort((a, b) => a - b);
  const mean_us = series.reduce((sum, value) => sum + value, 0) / series.length;
  const squares = series.reduce((sum, value) => sum + (value - mean_us) ** 2, 0);
  const [min_us, max_us] = [sorted[0], sorted.at(-1)];
  return {
    count: series.length,
    mean_us,
    median_us: sorted[Math.floor((sorted.length - 1) / 2)],
    p95_us: sorted[Math.floor(0.95 * (sorted.length - 1))],
    p99_us: sorted[Math.floor(0.99 * (sorted.length - 1))],
    min_us,
    max_us,
    standard_deviation_us: Math.sqrt(squares / (series.length - 1)),
    peak_to_peak_us: max_us - min_us,
    slope_us_per_sample: 0.01,
    intercept_us: mean_us,
  };
}

export class Bridge {
  constructor({ vehicles, wrongRoll }) {
    const mapRoll = wrongRoll ? ({ yaw }) => yaw : undefined;
    this.flights = Array.from(
      { length: vehicles },
      (_, index) => new Flight({ link: 1, system: index + 1, id: `14:40:00:0${index + 1}`, mapRoll }),
    );
    this.links = [{ number: 1, endpoint: 'udpin://127.0.0.1:14550', state: 'up' }];
    this.linksMade = 1;
    this.conversion = true;
    this.stepNumber = 0;
    this.crossingNumber = 0;
    this.rows = { mavlink: new Map(), dli: new Map() };
    this.totals = { mavlink: { messages: 0, bytes: 0 }, dli: { messages: 0, bytes: 0 } };
    this.delays = [];
    this.events = [];
    this.study = { kind: 'study', state: 'none', samples: 0, limit_ms: 0, done: 0 };
    this.note('link_up', 'info', 'udpin://127.0.0.1:14550');
    this.flights.forEach(({ id, system }) => this.note('vehicle_found', 'info', `system ${system}`, id));
  }

  /** One twentieth of a second passes. Returns each flight's crossings. */
  step() {
    const step = this.stepNumber++;
    const crossings = new Map();
    for (const flight of this.flights) {
      const own = flight.step(step, this.conversion, () => ++this.crossingNumber);
      crossings.set(flight.id, own);
      own.forEach((crossing) => this.count(crossing, flight.id));
    }
    if (this.study.state === 'running') this.goOnWithStudy();
    return crossings;
  }

  count({ mavlink, stages_ns, dli }, vehicle) {
    if (mavlink) {
      const { link, system, component, id, instance } = mavlink;
      this.countRow('mavlink', `${link}.${system}.${component}.${id}.${instance?.value}`, mavlink);
      if (mavlink.name === 'STATUSTEXT') this.note('status_text', 'info', mavlink.fields.text, vehicle);
    }
    for (const message of dli) this.countRow('dli', `${message.source}.${message.number}`, message);
    if (stages_ns?.sent !== undefined) this.delays.push(stages_ns);
    if (this.delays.length > 10_000) this.delays.shift();
  }

  countRow(side, key, last) {
    const count = (this.rows[side].get(key)?.count ?? 0) + 1;
    this.rows[side].set(key, {
      count,
      rate_hz: (count * stepsPerSecond) / Math.max(this.stepNumber, stepsPerSecond),
      last,
    });
    ++this.totals[side].messages;
    this.totals[side].bytes += last.hex.length / 2;
  }

  note(code, severity, text, vehicle) {
    const event = {
      number: this.events.length + 1,
      time_ms: start_us / 1000 + 50 * this.stepNumber,
      code,
      severity,
      ...(vehicle && { vehicle }),
      text,
    };
    this.events.push(event);
    this.onEvent?.(event);
  }

  connect(endpoint) {
    const link = { number: ++this.linksMade, endpoint, state: 'waiting' };
    this.links.push(link);
    this.note('link_up', 'info', endpoint);
    return link;
  }

  /** False: there is no such link. */
  disconnect(number) {
    const link = this.links.find((other) => other.number === number);
    this.links = this.links.filter((other) => other !== link);
    if (link) this.note('link_down', 'warning', link.endpoint);
    return link !== undefined;
  }

  convert(on) {
    this.conversion = on;
    this.note(on ? 'conversion_on' : 'conversion_off', 'info', '');
  }

  startStudy(samples, limit_ms) {
    this.study = { kind: 'study', state: 'running', samples, limit_ms, done: 0 };
  }

  stopStudy() {
    this.study = { kind: 'study', state: 'none', samples: 0, limit_ms: 0, done: 0 };
  }

  goOnWithStudy() {
    const done = Math.min(this.study.done + studySamplesPerStep, this.study.samples);
    this.study = { ...this.study, done, state: done === this.study.samples ? 'done' : 'running' };
    if (this.study.state === 'done') this.note('study_done', 'info', `${done} samples`);
  }

  studyResult() {
    const samples = Array.from({ length: this.study.samples }, (_, sample) => {
      const [present_direct_us, present_converted_us] = [30 + (sample % 7), 50 + ((sample * 13) % 29)];
      const [decoded_us, translated_us, sent_us] = [10, 25, 40];
      const [direct_us, converted_us] = [decoded_us + present_direct_us, sent_us + present_converted_us];
      return {
        index: sample + 1,
        time_us: start_us + 50_000 * sample,
        sequence: sample % 256,
        received_us: 50_000 * sample,
        decoded_us,
        translated_us,
        sent_us,
        present_direct_us,
        present_converted_us,
        direct_us,
        converted_us,
        delay_us: converted_us - direct_us,
      };
    });
    const of = (value) => summaryOf(samples.map(value));
    const summary = {
      direct: of(({ direct_us }) => direct_us),
      converted: of(({ converted_us }) => converted_us),
      delay: of(({ delay_us }) => delay_us),
      decode: of(({ decoded_us }) => decoded_us),
      translate: of(({ decoded_us, translated_us }) => translated_us - decoded_us),
      send: of(({ translated_us, sent_us }) => sent_us - translated_us),
      present_direct: of(({ present_direct_us }) => present_direct_us),
      present_converted: of(({ present_converted_us }) => present_converted_us),
    };
    const { limit_ms } = this.study;
    return {
      limit_ms,
      pass: summary.delay.max_us < limit_ms * 1000,
      summary,
      conditions: { machine: 'mock' },
      samples,
    };
  }

  status() {
    const totals = (side) => ({
      ...this.totals[side],
      rate_hz: (this.totals[side].messages * stepsPerSecond) / Math.max(this.stepNumber, 1),
      rejected: side === 'mavlink' ? 3 : 0,
    });
    return {
      kind: 'status',
      edition: '3',
      profile: 'default',
      conversion: this.conversion,
      budget_ms: 500,
      vehicle_links: this.links,
      dli_links: ['udpmulticast://239.255.45.86:45860'],
      vehicles: this.flights.map(({ id, link, system }) => ({
        id,
        link,
        system,
        autopilot: 3,
        type: 2,
        present: true,
      })),
      mavlink: totals('mavlink'),
      dli: totals('dli'),
    };
  }

  traffic() {
    return {
      kind: 'traffic',
      mavlink: [...this.rows.mavlink.values()],
      dli: [...this.rows.dli.values()],
      senders: this.flights.map(({ link, system }) => ({
        link,
        system,
        component: 1,
        received: this.stepNumber,
        lost: 2,
        late: 1,
        duplicates: 0,
      })),
      rejects: [{ side: 'mavlink', link: 1, reason: 'bad checksum', count: 3, bytes: 84 }],
    };
  }

  timing() {
    const times = (of) => {
      const sorted = this.delays.map(of).sort((a, b) => a - b);
      const share = (part) => sorted[Math.floor(part * (sorted.length - 1))] ?? 0;
      const buckets = Array(bounds_ns.length + 1).fill(0);
      for (const value of sorted) ++buckets[bounds_ns.filter((bound) => bound < value).length];
      return {
        count: sorted.length,
        p50_ns: share(0.5),
        p95_ns: share(0.95),
        p99_ns: share(0.99),
        max_ns: share(1),
        buckets,
      };
    };
    return {
      kind: 'timing',
      bounds_ns,
      decode: times(({ decoded }) => decoded),
      translate: times(({ decoded, translated }) => translated - decoded),
      send: times(({ translated, sent }) => sent - translated),
      total: times(({ sent }) => sent),
    };
  }
}
