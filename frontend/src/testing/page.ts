/** The page of one person at a fake server, with the real stores; a test mounts the panel that it is about. */
import { cleanup, configure } from "@testing-library/react";
import { userEvent } from "@testing-library/user-event";
import { afterEach, expect, vi } from "vitest";
import { connectStores } from "../app/dispatch";
import { onNavigate } from "../store/page/navigate";
import { start } from "../store/plc/bench";
import { usePlc } from "../store/plc/plc";
import { link } from "../wire/socket";
import { fillGaps } from "./browser";
import { FakeServer } from "./server";
import { connectTo } from "./socket";

// Nothing here is hidden by a style: whether it could be seen is asked of a browser. And a slow machine is no failure.
configure({ defaultHidden: true, asyncUtilTimeout: 20_000 });
vi.setConfig({ testTimeout: 60_000 });
fillGaps();
connectStores();

let tests = 0;
let now: FakeServer | null = null;
/** Where the page went: `file Main.st`, `panel errors`, `page record`. */
let places: string[] = [];

/** Opens the page. `prepare` says what the server has before the page asks. */
export async function openPage(prepare: (server: FakeServer) => void = () => undefined) {
  tests += 1;
  localStorage.clear();
  const server = new FakeServer(tests);
  now = server;
  prepare(server);
  connectTo(server);
  vi.stubGlobal("fetch", server.fetch);
  places = [];
  const went = (kind: string) => (name: string) => places.push(`${kind} ${name}`);
  onNavigate({ file: went("file"), panel: went("panel"), page: went("page") });
  await start();
  await vi.waitFor(() => expect(usePlc.getState().state).not.toBeNull());
  return { server, places, user: userEvent.setup() };
}

afterEach(() => {
  cleanup();
  link.connect(null);
  expect(now?.unknown ?? []).toEqual([]);
  now = null;
});
