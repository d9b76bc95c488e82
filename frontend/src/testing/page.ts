/** The page of one person at a fake server, with the real stores; a test mounts the panel that it is about. */
import { cleanup, configure } from "@testing-library/react";
import { userEvent } from "@testing-library/user-event";
import { expect, onTestFinished, vi } from "vitest";
import { connectStores } from "../app/dispatch";
import { onNavigate } from "../store/page/navigate";
import { start } from "../store/plc/bench";
import { usePlc } from "../store/plc/plc";
import { link } from "../wire/socket";
import { eventually, LIMIT } from "./eventually";
import { FakeServer } from "./server";
import { connectTo } from "./socket";

configure({
  defaultHidden: true, // nothing here is hidden by a style: whether it could be seen is asked of a browser
  asyncUtilTimeout: LIMIT,
  getElementError: (message) => new Error(message ?? ""), // not the whole page
});
connectStores();

let tests = 0;

/**
 * Opens the page of a project and a PLC of its own, so that the page forgets those of the test before. `prepare` says what the server has
 * before the page asks; `places` is where the page went: `file Main.st`, `panel errors`, `page record`.
 */
export async function openPage(prepare: (server: FakeServer) => void = () => undefined) {
  tests += 1;
  localStorage.clear();
  const server = new FakeServer(tests);
  onTestFinished(() => {
    cleanup();
    link.connect(null);
    expect(server.unknown).toEqual([]);
  });
  prepare(server);
  connectTo(server);
  vi.stubGlobal("fetch", server.fetch);
  const places: string[] = [];
  const went = (kind: string) => (name: string) => places.push(`${kind} ${name}`);
  onNavigate({ file: went("file"), panel: went("panel"), page: went("page") });
  await start();
  await eventually(() => expect(usePlc.getState().state).not.toBeNull());
  return { server, places, user: userEvent.setup() };
}
