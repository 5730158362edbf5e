import type { DliMessage, MavlinkMessage } from '../contract';
import { Series } from './series';
import { mavlinkKey } from './traffic';

/** A field that is plotted: of a MAVLink message (an element, where it is an array), or of a DLI message. */
export type PlotSource =
  | { side: 'mavlink'; sample: MavlinkMessage; field: string; element?: number } // `sample`: any message of the kind
  | { side: 'dli'; source: string; number: number; field: string };

const capacity = 3000;

/** The curve of one field. */
export class Plot {
  readonly series = new Series(capacity);

  constructor(readonly source: PlotSource) {}

  get title(): string {
    const { source } = this;
    if (source.side === 'dli') return `#${source.number} ${source.field} (${source.source})`;
    const { name, instance, system, component } = source.sample;
    const element = source.element === undefined ? '' : `[${source.element}]`;
    return `${name}${instance ? ` ${instance.value}` : ''} ${source.field}${element} (${system}/${component})`;
  }

  onMavlink(message: MavlinkMessage): void {
    const { source } = this;
    if (source.side !== 'mavlink' || mavlinkKey(message) !== mavlinkKey(source.sample)) return;
    const field = message.fields?.[source.field];
    const value = Array.isArray(field) ? field[source.element ?? 0] : field;
    this.series.add(message.time_us / 1e6, numberOrGap(value));
  }

  onDli(message: DliMessage): void {
    const { source } = this;
    if (source.side !== 'dli' || message.source !== source.source || message.number !== source.number) return;
    const field = message.fields[source.field] ?? message.held[source.field];
    this.series.add(message.time_ms / 1e3, numberOrGap(field?.value ?? field?.raw));
  }
}

function numberOrGap(value: number | string | undefined): number | null {
  const number = typeof value === 'string' ? Number(value) : (value ?? NaN);
  return Number.isFinite(number) ? number : null;
}
