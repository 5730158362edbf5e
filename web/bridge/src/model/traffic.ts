import type { DliMessage, DliRow, MavlinkMessage, MavlinkRow, Reject, Sender, Traffic } from '../contract';

/** The inspector's table: the newest row of every key. */
export class TrafficTable {
  private readonly mavlinkRows = new Map<string, MavlinkRow>();
  private readonly dliRows = new Map<string, DliRow>();
  private readonly senderRows = new Map<string, Sender>();
  private readonly rejectRows = new Map<string, Reject>();

  add(traffic: Traffic): void {
    for (const row of traffic.mavlink) this.mavlinkRows.set(mavlinkKey(row.last), row);
    for (const row of traffic.dli) this.dliRows.set(dliKey(row.last), row);
    for (const row of traffic.senders) this.senderRows.set(`${row.link}.${row.system}.${row.component}`, row);
    for (const row of traffic.rejects) this.rejectRows.set(`${row.side}.${row.link}.${row.reason}`, row);
  }

  /** Those whose text has every word of the filter, in any case. */
  mavlink(filter: string): MavlinkRow[] {
    const rows = [...this.mavlinkRows.values()].filter(({ last }) =>
      matches(filter, `${last.name} ${last.id} ${last.link}/${last.system}/${last.component} ${names(last.fields)}`),
    );
    return rows.sort(
      (a, b) =>
        a.last.link - b.last.link ||
        a.last.system - b.last.system ||
        a.last.component - b.last.component ||
        a.last.id - b.last.id ||
        (a.last.instance?.value ?? 0) - (b.last.instance?.value ?? 0),
    );
  }

  dli(filter: string): DliRow[] {
    const rows = [...this.dliRows.values()].filter(({ last }) =>
      matches(filter, `${last.name} #${last.number} ${last.source} ${names(last.fields)} ${names(last.held)}`),
    );
    return rows.sort((a, b) => a.last.source.localeCompare(b.last.source) || a.last.number - b.last.number);
  }

  senders(): Sender[] {
    return [...this.senderRows.values()].sort(
      (a, b) => a.link - b.link || a.system - b.system || a.component - b.component,
    );
  }

  rejects(): Reject[] {
    return [...this.rejectRows.values()].sort((a, b) => b.count - a.count);
  }
}

/** What tells the messages of one row from those of others. */
export function mavlinkKey({ link, system, component, id, instance }: MavlinkMessage): string {
  return `${link}.${system}.${component}.${id}.${instance?.value ?? ''}`;
}

export function dliKey({ source, number }: DliMessage): string {
  return `${source}.${number}`;
}

function matches(filter: string, text: string): boolean {
  const lower = text.toLowerCase();
  return filter
    .toLowerCase()
    .split(/\s+/)
    .every((word) => lower.includes(word));
}

function names(fields: object | undefined): string {
  return Object.keys(fields ?? {}).join(' ');
}
