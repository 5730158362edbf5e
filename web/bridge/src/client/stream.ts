import type { ServerMessage, Watch } from '../contract';

export type Connection = 'connecting' | 'live' | 'lost';

const firstPause_ms = 500;
const longestPause_ms = 5000;

/** The WebSocket to the server. When it is lost it is opened again, after pauses that grow from 0.5 to 5 seconds. */
export class Stream {
  private socket: WebSocket | undefined;
  private pause_ms = firstPause_ms;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private wanted: Watch | undefined;

  constructor(
    private readonly onMessage: (message: ServerMessage) => void,
    private readonly onConnection: (connection: Connection) => void,
  ) {}

  /** Opens it, or closes and opens it again: with a new session. */
  open(): void {
    clearTimeout(this.retry);
    this.socket?.close();
    const address = new URL('/api/v1/stream', location.href);
    address.protocol = address.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(address);
    this.socket = socket;
    socket.onopen = () => {
      this.pause_ms = firstPause_ms;
      this.onConnection('live');
      this.sendWanted();
    };
    socket.onmessage = ({ data }) => this.onMessage(JSON.parse(String(data)) as ServerMessage);
    socket.onclose = () => {
      if (socket === this.socket) this.reopenLater();
    };
  }

  /** Tells the server what to send, now and after each new connection. */
  watch(wanted: Watch): void {
    this.wanted = wanted;
    this.sendWanted();
  }

  private sendWanted(): void {
    if (this.wanted !== undefined && this.socket?.readyState === WebSocket.OPEN)
      this.socket.send(JSON.stringify(this.wanted));
  }

  private reopenLater(): void {
    this.onConnection('lost');
    this.retry = setTimeout(() => this.open(), this.pause_ms);
    this.pause_ms = Math.min(2 * this.pause_ms, longestPause_ms);
  }
}
