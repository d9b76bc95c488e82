/** A client of the Debug Adapter Protocol; its messages travel in an envelope on the page's own connection. */
import type { DebugProtocol } from "@vscode/debugprotocol";
import { link } from "./socket";

export type { DebugProtocol } from "@vscode/debugprotocol";

/** The adapter's refusal, in its words. */
class DapRefused extends Error {}

interface Waiting {
  resolve: (body: unknown) => void;
  reject: (error: DapRefused) => void;
}

type Post = (message: DebugProtocol.Request) => boolean;
type Listener = (body: unknown) => void;

export class DapClient {
  private seq = 0;
  private readonly waiting = new Map<number, Waiting>();
  private readonly listeners = new Map<string, Listener[]>();

  constructor(private readonly post: Post) {}

  /** The body of the response; rejects with `DapRefused`, also when there is no connection. */
  request<T = void>(command: string, args: object = {}): Promise<T> {
    this.seq += 1;
    const message: DebugProtocol.Request = { seq: this.seq, type: "request", command, arguments: args };
    return new Promise<T>((resolve, reject) => {
      this.waiting.set(message.seq, { resolve: resolve as Waiting["resolve"], reject });
      if (this.post(message)) return;
      this.waiting.delete(message.seq);
      reject(new DapRefused(""));
    });
  }

  on(event: string, listener: Listener): void {
    this.listeners.set(event, [...(this.listeners.get(event) ?? []), listener]);
  }

  receive(message: object): void {
    const told = message as DebugProtocol.ProtocolMessage;
    if (told.type === "event") {
      const { event, body } = told as DebugProtocol.Event;
      for (const listener of this.listeners.get(event) ?? []) listener(body);
    } else if (told.type === "response") this.settle(told as DebugProtocol.Response);
  }

  private settle(response: DebugProtocol.Response): void {
    const request = this.waiting.get(response.request_seq);
    this.waiting.delete(response.request_seq);
    if (response.success) request?.resolve(response.body);
    else request?.reject(new DapRefused(reasonOf(response)));
  }

  /** The connection was lost: rejects all pending requests. */
  abandon(): void {
    const pending = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of pending) reject(new DapRefused(""));
  }
}

/** The long text of an error response, with its variables filled in; else the short one. */
function reasonOf({ message, body }: DebugProtocol.Response): string {
  const error = (body as { error?: DebugProtocol.Message } | undefined)?.error;
  if (!error) return message ?? "";
  return error.format.replace(/\{(\w+)\}/g, (whole, name: string) => error.variables?.[name] ?? whole);
}

export const dap = new DapClient((message) => link.post({ type: "dap", message: { ...message } }));
