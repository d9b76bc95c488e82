/** A client of the Language Server Protocol on a WebSocket: one JSON message a text. It connects again by itself; what is asked meanwhile has
 * no answer, which for an editor is nothing to tell. */

/** The server's refusal, in its words. */
export class LspRefused extends Error {}

interface Waiting {
  resolve: (result: unknown) => void;
  reject: (error: LspRefused) => void;
}

interface Incoming {
  id?: number;
  method?: string;
  result?: unknown;
  error?: { message: string };
}

const FIRST_DELAY = 1000;
const LONGEST_DELAY = 15_000;

export class LspClient {
  private socket: WebSocket | null = null;
  private readonly waiting = new Map<number, Waiting>();
  private lastId = 0;
  private ready = false;
  /** Who waits until there is a server, or until it is clear that none comes now. */
  private readonly onSettled: (() => void)[] = [];
  private delay = FIRST_DELAY;
  private retry: ReturnType<typeof setTimeout> | undefined;

  /** `onReady`: a server is there that knows no texts yet. */
  constructor(
    private readonly path: string,
    private readonly onReady: () => void,
  ) {
    this.open();
  }

  close(): void {
    clearTimeout(this.retry);
    const { socket } = this;
    this.socket = null;
    this.ready = false;
    socket?.close();
    this.abandon();
  }

  /** The answer; null where no server comes. Rejects with `LspRefused`. */
  async request<T>(method: string, params: object, signal?: AbortSignal): Promise<T | null> {
    if (!this.ready) await new Promise<void>((go) => this.onSettled.push(go));
    return this.ready && !signal?.aborted ? this.ask<T>(method, params, signal) : null;
  }

  notify(method: string, params: object): void {
    if (this.ready) this.post({ method, params });
  }

  private ask<T>(method: string, params: object, signal?: AbortSignal): Promise<T | null> {
    this.lastId += 1;
    const id = this.lastId;
    return new Promise<T | null>((resolve, reject) => {
      this.waiting.set(id, { resolve: resolve as Waiting["resolve"], reject });
      signal?.addEventListener("abort", () => {
        if (!this.waiting.delete(id)) return;
        this.post({ method: "$/cancelRequest", params: { id } });
        resolve(null);
      });
      this.post({ id, method, params });
    });
  }

  private post(message: object): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ jsonrpc: "2.0", ...message }));
  }

  private open(): void {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}${this.path}`);
    this.socket = socket;
    socket.onopen = () => void this.initialize(socket);
    socket.onmessage = ({ data }: MessageEvent<string>) => this.receive(JSON.parse(data) as Incoming);
    socket.onclose = () => {
      if (socket !== this.socket) return;
      this.ready = false;
      this.abandon();
      this.retry = setTimeout(() => this.open(), this.delay);
      this.delay = Math.min(2 * this.delay, LONGEST_DELAY);
    };
  }

  private async initialize(socket: WebSocket): Promise<void> {
    const capabilities = { textDocument: { completion: { completionItem: { snippetSupport: true } } } };
    // The line above the text says in which statement the caret is; a number above a declaration lists what it counts.
    const initializationOptions = { statements: true, lists: true };
    const asked = { processId: null, rootUri: null, capabilities, initializationOptions };
    const said = await this.ask("initialize", asked).catch(() => null);
    if (said === null || socket !== this.socket) return;
    this.post({ method: "initialized", params: {} });
    this.ready = true;
    this.delay = FIRST_DELAY;
    this.onReady();
    this.settle();
  }

  private receive(message: Incoming): void {
    if (message.method !== undefined) {
      // A question of the server, of which this client expects none, must not stay without an answer.
      if (message.id !== undefined) this.post({ id: message.id, result: null });
      return;
    }
    const request = this.waiting.get(message.id ?? 0);
    this.waiting.delete(message.id ?? 0);
    if (message.error) request?.reject(new LspRefused(message.error.message));
    else request?.resolve(message.result);
  }

  /** The connection was lost: pending requests have no answer. */
  private abandon(): void {
    const pending = [...this.waiting.values()];
    this.waiting.clear();
    for (const { resolve } of pending) resolve(null);
    this.settle();
  }

  private settle(): void {
    for (const go of this.onSettled.splice(0)) go();
  }
}
