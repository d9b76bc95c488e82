/** The one connection to a virtual PLC: connects, reconnects by itself with back-off, and passes messages on. */
import { type Frame, parseFrame } from "./frames";
import type { ClientMessage, ServerMessage } from "./types";

export interface LinkStatus {
  state: "none" | "connecting" | "open" | "lost";
  /** Wall time (ms) of the loss, and the number of attempts to reconnect since. */
  lostAt: number | null;
  attempt: number;
  /** Wall time (ms) of the next attempt. */
  nextTryAt: number | null;
}

interface LinkListener {
  onStatus(status: LinkStatus): void;
  onMessage(message: ServerMessage): void;
  onFrame(frame: Frame): void;
}

const FIRST_DELAY = 500;
const LONGEST_DELAY = 8000;
/** A socket that opens but stays silent is closed after this time, in ms. */
const HELLO_TIMEOUT = 5000;
/** The server sends something at least every 5 s: after this silence it is frozen or out of reach, though nothing was closed. */
const SILENCE_TIMEOUT = 12_000;

class Link {
  private socket: WebSocket | null = null;
  private instance: number | null = null;
  private retry: ReturnType<typeof setTimeout> | undefined;
  private patience: ReturnType<typeof setTimeout> | undefined;
  private listener: LinkListener | null = null;
  private status: LinkStatus = { state: "none", lostAt: null, attempt: 0, nextTryAt: null };

  listen(listener: LinkListener): void {
    this.listener = listener;
  }

  /** Opens the connection to an instance and closes the previous one; null only closes. */
  connect(instance: number | null): void {
    this.close();
    this.instance = instance;
    if (instance === null) {
      this.report({ state: "none", lostAt: null, attempt: 0, nextTryAt: null });
      return;
    }
    this.report({ state: "connecting", lostAt: null, attempt: 0, nextTryAt: null });
    this.open();
  }

  /** Connects again to the same instance, which then tells everything again. */
  again(): void {
    if (this.instance !== null) this.connect(this.instance);
  }

  /** Connects at once instead of waiting for the next turn. */
  tryNow(): void {
    if (this.status.state !== "lost") return;
    clearTimeout(this.retry);
    this.open();
  }

  get isOpen(): boolean {
    return this.status.state === "open";
  }

  /** False when there is no connection. Nothing is queued, because a write from a minute ago may no longer be wanted. */
  post(message: ClientMessage): boolean {
    if (!this.isOpen || this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private open(): void {
    this.drop();
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/api/instances/${this.instance}/socket`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.expectWithin(HELLO_TIMEOUT);
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (socket === this.socket) this.receive(event.data);
    };
    socket.onclose = () => {
      if (socket === this.socket) this.lose();
    };
  }

  /** A frozen server does not answer a close either, so the socket is dropped without waiting for its end. */
  private expectWithin(ms: number): void {
    clearTimeout(this.patience);
    this.patience = setTimeout(() => {
      this.drop();
      this.lose();
    }, ms);
  }

  private receive(data: string | ArrayBuffer): void {
    if (this.isOpen) this.expectWithin(SILENCE_TIMEOUT);
    if (typeof data !== "string") {
      this.listener?.onFrame(parseFrame(data));
      return;
    }
    const message = JSON.parse(data) as ServerMessage;
    if (message.type === "hello") {
      this.expectWithin(SILENCE_TIMEOUT);
      this.report({ state: "open", lostAt: null, attempt: 0, nextTryAt: null });
    }
    this.listener?.onMessage(message);
  }

  private lose(): void {
    clearTimeout(this.patience);
    this.socket = null;
    const attempt = this.status.attempt + 1;
    const delay = Math.min(LONGEST_DELAY, FIRST_DELAY * 2 ** (attempt - 1));
    this.report({
      state: "lost",
      lostAt: this.status.lostAt ?? Date.now(),
      attempt,
      nextTryAt: Date.now() + delay,
    });
    this.retry = setTimeout(() => this.open(), delay);
  }

  private close(): void {
    clearTimeout(this.retry);
    this.drop();
  }

  private drop(): void {
    clearTimeout(this.patience);
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  private report(status: LinkStatus): void {
    this.status = status;
    this.listener?.onStatus(status);
  }
}

export const link = new Link();
