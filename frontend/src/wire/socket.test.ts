import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { connectTo, FakeSocket, type FakeSocket as Socket } from "../testing/socket";
import { type LinkStatus, link } from "./socket";

/** The server's end: it greets, unless it is frozen. */
let sockets: Socket[] = [];
let frozen = false;
let states: LinkStatus[] = [];

const ALIVE = JSON.stringify({ type: "alive" });
const now = () => states.at(-1);

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("location", { protocol: "http:", host: "localhost" });
  [sockets, states, frozen] = [[], [], false];
  connectTo({
    opened: (socket) => {
      sockets.push(socket);
      if (!frozen) socket.receive(JSON.stringify({ type: "hello" }));
    },
    heard: () => undefined,
  });
  link.listen({ onStatus: (status) => states.push(status), onMessage: () => undefined, onFrame: () => undefined });
});
afterEach(() => {
  link.connect(null);
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

async function connected(): Promise<void> {
  link.connect(1);
  await vi.advanceTimersByTimeAsync(0);
  expect(now()?.state).toBe("open");
}

test("a server that has nothing to say but that it lives is no loss", async () => {
  await connected();
  for (let seconds = 0; seconds < 60; seconds += 5) {
    await vi.advanceTimersByTimeAsync(5000);
    sockets[0]?.receive(ALIVE);
  }
  expect(now()?.state).toBe("open");
  expect(sockets).toHaveLength(1);
});

test("a frozen server closes nothing, and is noticed all the same; each try is given up, the next one comes later", async () => {
  await connected();
  frozen = true;
  await vi.advanceTimersByTimeAsync(11_000);
  expect(now()?.state).toBe("open");
  await vi.advanceTimersByTimeAsync(1500);
  expect(now()).toMatchObject({ state: "lost", attempt: 1 });
  const { lostAt } = now() as LinkStatus;
  await vi.advanceTimersByTimeAsync(6000);
  expect(now()).toMatchObject({ state: "lost", attempt: 2, lostAt });
  expect(link.post({ type: "unwatch", ids: [] })).toBe(false);

  frozen = false;
  await vi.advanceTimersByTimeAsync(8000);
  expect(now()).toEqual({ state: "open", lostAt: null, attempt: 0, nextTryAt: null });
});

test("a connection that breaks is tried again by itself, at once when told to", async () => {
  await connected();
  sockets[0]?.break();
  expect(now()).toMatchObject({ state: "lost", attempt: 1 });
  link.tryNow();
  await vi.advanceTimersByTimeAsync(0);
  expect(now()?.state).toBe("open");
  expect(sockets).toHaveLength(2);
});
