// The messages of web/contract, as TypeScript sees them. The meaning and the units stand there.

export type Role = 'watch' | 'command';
export type Edition = '3' | 'A';

export interface VehicleLink {
  number: number;
  endpoint: string;
  state: 'up' | 'waiting';
  detail?: string;
}

export interface Vehicle {
  id: string;
  link: number;
  system: number;
  autopilot: number;
  type: number;
  present: boolean;
}

export interface Totals {
  messages: number;
  bytes: number;
  rate_hz: number;
  rejected: number;
}

export interface Status {
  kind: 'status';
  edition: Edition;
  profile: string;
  conversion: boolean;
  budget_ms: number;
  vehicle_links: VehicleLink[];
  dli_links: string[];
  vehicles: Vehicle[];
  mavlink: Totals;
  dli: Totals;
}

export type EventCode =
  | 'link_up'
  | 'link_down'
  | 'vehicle_found'
  | 'vehicle_lost'
  | 'vehicle_returned'
  | 'vehicle_rebooted'
  | 'duplicate_id'
  | 'status_text'
  | 'conversion_on'
  | 'conversion_off'
  | 'study_done'
  | 'study_failed'
  | 'other';

export interface Event {
  number: number;
  time_ms: number;
  code: EventCode;
  severity: 'info' | 'warning' | 'error';
  vehicle?: string;
  text: string;
}

export type MavlinkValue = number | string | (number | string)[];

export interface MavlinkMessage {
  link: number;
  time_us: number;
  id: number;
  name: string;
  version: 0.9 | 1 | 2;
  system: number;
  component: number;
  sequence: number;
  instance?: { field: string; value: number };
  fields?: Record<string, MavlinkValue>;
  hex: string;
}

export interface DliValue {
  raw: number | string;
  value?: number;
  unit?: string;
  label?: string | string[]; // several: the set bits of a bitmap
}

export type DliFields = Record<string, DliValue>;

export interface DliMessage {
  time_ms: number;
  number: number;
  name: string;
  edition: Edition;
  source: string;
  destination: string;
  fields: DliFields;
  held: DliFields;
  hex: string;
}

export interface Stages {
  decoded: number;
  translated?: number;
  sent?: number;
}

export interface Crossing {
  number: number;
  mavlink?: MavlinkMessage;
  stages_ns?: Stages;
  dli: DliMessage[];
}

export interface MavlinkRow {
  count: number;
  rate_hz: number;
  last: MavlinkMessage;
}

export interface DliRow {
  count: number;
  rate_hz: number;
  last: DliMessage;
}

export interface Sender {
  link: number;
  system: number;
  component: number;
  received: number;
  lost: number;
  late: number;
  duplicates: number;
}

export interface Reject {
  side: 'mavlink' | 'dli';
  link?: number;
  reason: string;
  count: number;
  bytes: number;
}

export interface Traffic {
  kind: 'traffic';
  mavlink: MavlinkRow[];
  dli: DliRow[];
  senders: Sender[];
  rejects: Reject[];
}

export interface StageTimes {
  count: number;
  p50_ns: number;
  p95_ns: number;
  p99_ns: number;
  max_ns: number;
  buckets: number[];
}

export const stageNames = ['decode', 'translate', 'send', 'total'] as const;
export type StageName = (typeof stageNames)[number];

export type Timing = { kind: 'timing'; bounds_ns: number[] } & Record<StageName, StageTimes>;

export interface Study {
  kind: 'study';
  state: 'none' | 'running' | 'done' | 'failed';
  samples: number;
  limit_ms: number;
  done: number;
  detail?: string;
}

export interface Hello {
  kind: 'hello';
  version: string;
  role: Role;
  session: boolean;
}

export type ServerMessage =
  | Hello
  | Status
  | { kind: 'events'; events: Event[] }
  | { kind: 'crossings'; crossings: Crossing[] }
  | Traffic
  | Timing
  | Study
  | { kind: 'dropped'; count: number }
  | { kind: 'refusal'; code: string; detail: string };

export interface Watch {
  kind: 'watch';
  vehicle: string | null;
  traffic: boolean;
}

export interface Port {
  device: string;
  by_id: string;
  autopilot: boolean;
}

export interface Problem {
  code: string;
  detail: string;
}

export interface StudySummary {
  mean_us: number;
  median_us: number;
  p95_us: number;
  min_us: number;
  max_us: number;
  standard_deviation_us: number;
  slope_us_per_sample: number;
}

export const studySeries = ['direct', 'converted', 'delay'] as const;

export interface StudyResult {
  limit_ms: number;
  pass: boolean;
  summary: Record<(typeof studySeries)[number], StudySummary>;
  samples: { index: number; direct_us: number; converted_us: number; delay_us: number }[];
}

export type MavlinkType =
  'char' | 'uint8' | 'int8' | 'uint16' | 'int16' | 'uint32' | 'int32' | 'uint64' | 'int64' | 'float' | 'double';

export interface MavlinkFieldInfo {
  name: string;
  type: MavlinkType;
  offset: number;
  array_length?: number;
  unit?: string;
  enum?: string;
}

export interface MavlinkMessageInfo {
  id: number;
  name: string;
  fields: MavlinkFieldInfo[];
}

export interface EnumInfo {
  bitmask: boolean;
  labels: Record<string, string>;
}

export interface DliFieldInfo {
  number: number;
  key: string;
  name: string;
  type: 'unsigned' | 'signed' | 'bam' | 'float' | 'text' | 'variable_text';
  width: number;
  length_from?: number;
  scale?: number;
  unit?: string;
  guessed?: true;
}

export type Confidence = 'standard' | 'single_source' | 'inferred' | 'unknown';

export interface DliMessageInfo {
  number: number;
  name: string;
  presence_bytes: number;
  confidence: Confidence;
  fields: DliFieldInfo[];
}

export interface FromMavlinkRule {
  message: string;
  sources: string[];
  fact: string;
  rule: string;
  unit: string;
  rank: number;
  reference: string;
}

export interface ToDliRule {
  number: number;
  field: string;
  facts: string[];
  rule: string;
  reference: string;
  confidence: Confidence;
}

export interface CatalogueData {
  mavlink: { messages: MavlinkMessageInfo[]; enums: Record<string, EnumInfo> };
  dli: { messages: DliMessageInfo[] };
  rules: { from_mavlink: FromMavlinkRule[]; to_dli: ToDliRule[] };
}
