import { batch, computed, effect, signal, untracked } from '@preact/signals';
import { api, Refused } from '../client/api';
import { Stream, type Connection } from '../client/stream';
import type { Crossing, Event, Hello, Role, ServerMessage, Status, Study, Timing, Traffic } from '../contract';
import { Catalogue } from '../model/catalogue';
import { Crossings } from '../model/crossings';
import { withDelays, type Delay } from '../model/delays';
import { Plot } from '../model/plot';
import { TrafficTable } from '../model/traffic';

export const views = ['bridge', 'inspector', 'timing', 'links'] as const;
export type View = (typeof views)[number];

/** How often what is read, rather than watched, changes on the screen. */
const readingPause_ms = 250;
const eventsKept = 500;

// What the server says.
export const connection = signal<Connection>('connecting');
export const role = signal<Role | undefined>();
export const hasSession = signal(false);
export const version = signal('');
export const status = signal<Status | undefined>();
export const timing = signal<Timing | undefined>();
export const study = signal<Study | undefined>();
export const events = signal<Event[]>([]);
export const dropped = signal(0);
export const catalogue = signal<Catalogue | undefined>();
export const delays = signal<Delay[]>([]);
export const needsToken = signal(false);
/** Why the last action was refused. */
export const problem = signal<string | undefined>();

// What the person wants to see.
export const view = signal<View>('bridge');
export const paused = signal(false);
export const chosenVehicle = signal<string | undefined>();
export const plots = signal<Plot[]>([]);

/** The watched vehicle: the chosen one, else the first. */
export const vehicle = computed(() => {
  const vehicles = status.value?.vehicles ?? [];
  return vehicles.find(({ id }) => id === chosenVehicle.value) ?? vehicles[0];
});
export const vehicleId = computed(() => vehicle.value?.id);

/** Large tables that change many times a second; `motion` and `reading` say when to look again. */
export const live = { crossings: new Crossings(), traffic: new TrafficTable() };
/** Changes with every message, for what moves. */
export const motion = signal(0);
/** Changes at most four times a second, for what is read. */
export const reading = signal(0);

let readingDue: ReturnType<typeof setTimeout> | undefined;
function announce(): void {
  ++motion.value;
  readingDue ??= setTimeout(() => {
    readingDue = undefined;
    ++reading.value;
  }, readingPause_ms);
}

function forgetVehicle(): void {
  live.crossings = new Crossings();
  delays.value = [];
  announce();
}

// A new connection may lead to another program: nothing of the old one is mixed with what it tells.
function onHello(message: Hello): void {
  version.value = message.version;
  role.value = message.role;
  hasSession.value = message.session;
  needsToken.value = false;
  events.value = [];
  dropped.value = 0;
  live.traffic = new TrafficTable();
  forgetVehicle();
  void loadCatalogue();
}

// Some of another vehicle's may be under way still when the watched one changes.
function isOfWatched({ mavlink }: Crossing): boolean {
  return mavlink === undefined || (mavlink.link === vehicle.value?.link && mavlink.system === vehicle.value.system);
}

function onCrossings(crossings: Crossing[]): void {
  const added = crossings.filter(isOfWatched);
  live.crossings.add(added);
  delays.value = withDelays(delays.value, added);
  for (const { mavlink, dli } of added) {
    if (mavlink) plots.value.forEach((plot) => plot.onMavlink(mavlink));
    for (const message of dli) plots.value.forEach((plot) => plot.onDli(message));
  }
  announce();
}

function onTraffic(message: Traffic): void {
  live.traffic.add(message);
  for (const { last } of message.mavlink) plots.value.forEach((plot) => plot.onMavlink(last));
  for (const { last } of message.dli) plots.value.forEach((plot) => plot.onDli(last));
  announce();
}

function onMessage(message: ServerMessage): void {
  switch (message.kind) {
    case 'hello':
      return onHello(message);
    case 'status':
      status.value = message;
      return;
    case 'timing':
      timing.value = message;
      return;
    case 'study':
      study.value = message;
      return;
    case 'dropped':
      dropped.value = message.count;
      return;
    case 'events':
      events.value = [...events.value, ...message.events].slice(-eventsKept);
      return;
    // What was under way when the page was paused must not move it.
    case 'crossings':
      return paused.value ? undefined : onCrossings(message.crossings);
    case 'traffic':
      return paused.value ? undefined : onTraffic(message);
    case 'refusal':
      problem.value = message.detail;
  }
}

const stream = new Stream(
  (message) => batch(() => onMessage(message)),
  (state) => {
    connection.value = state;
    if (state === 'lost') void loadCatalogue();
  },
);

// Asked for with every connection, since the program may be another one; also tells a lost connection from a lost
// session, which a WebSocket cannot.
async function loadCatalogue(): Promise<void> {
  try {
    catalogue.value = new Catalogue(await api.catalogue());
  } catch (error) {
    needsToken.value = error instanceof Refused && error.status === 401;
  }
}

/** Does what the server is asked to do; a refusal is shown until the next action. */
export async function act<T>(action: Promise<T>): Promise<T | undefined> {
  problem.value = undefined;
  try {
    return await action;
  } catch (error) {
    problem.value = error instanceof Error ? error.message : String(error);
    return undefined;
  }
}

export async function signIn(token: string): Promise<void> {
  if (await act(api.signIn(token))) stream.open();
}

export async function signOut(): Promise<void> {
  await act(api.signOut());
  role.value = undefined;
  stream.open();
}

/** Begins to listen. A token in the address (`#token=...`) is exchanged for a session and removed from there. */
export async function start(): Promise<void> {
  effect(() => {
    stream.watch({
      kind: 'watch',
      vehicle: paused.value ? null : (vehicleId.value ?? null),
      traffic: !paused.value && view.value === 'inspector',
    });
  });
  effect(() => {
    if (vehicleId.value !== undefined) untracked(forgetVehicle);
  });
  const token = new URLSearchParams(location.hash.slice(1)).get('token');
  if (token !== null) {
    history.replaceState(null, '', location.pathname);
    await act(api.signIn(token));
  }
  stream.open();
}
