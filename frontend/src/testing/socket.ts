/** The browser's WebSocket, as far as `wire/socket.ts` uses it; the other end is a fake server. */

interface End {
  opened(socket: FakeSocket): void;
  heard(text: string, socket: FakeSocket): void;
}

let end: End | null = null;

/** Where new sockets lead. */
export function connectTo(server: End): void {
  end = server;
}

export class FakeSocket {
  static readonly CONNECTING = 0;
  static readonly OPEN = 1;
  static readonly CLOSED = 3;
  readyState = FakeSocket.CONNECTING;
  binaryType = "blob";
  onmessage: ((event: { data: string | ArrayBuffer }) => void) | null = null;
  onclose: (() => void) | null = null;
  private readonly end = end;

  constructor(readonly url: string) {
    queueMicrotask(() => {
      if (this.readyState === FakeSocket.CLOSED) return;
      this.readyState = FakeSocket.OPEN;
      this.end?.opened(this);
    });
  }

  send(text: string): void {
    this.end?.heard(text, this);
  }

  close(): void {
    this.readyState = FakeSocket.CLOSED;
  }

  /** Something comes from the server. */
  receive(data: string | ArrayBuffer): void {
    if (this.readyState === FakeSocket.OPEN) this.onmessage?.({ data });
  }

  /** The connection breaks. */
  break(): void {
    this.readyState = FakeSocket.CLOSED;
    this.onclose?.();
  }
}
