import { beforeEach, expect, test, vi } from "vitest";
import type { ValueRow } from "../../../logic/watch/watchrows";
import { usePlc } from "../../../store/plc/plc";
import { apply, assign } from "../../../store/plc/values";
import { useWatches } from "../../../store/plc/watches";
import type { InstanceState, PlcSymbol } from "../../../wire/types";
import { gridKey } from "./gridKeys";
import { rowMenu } from "./rowMenu";

const sent = vi.hoisted(() => [] as object[]);
vi.mock("../../../wire/send", () => ({
  newRef: () => 1,
  send: async (message: object) => {
    sent.push(message);
    return { ok: true, message: "" };
  },
}));
vi.mock("../../../wire/socket", () => ({ link: { post: () => true } }));

const symbol: PlcSymbol = {
  path: "motor",
  name: "motor",
  type: "BOOL",
  kind: "bool",
  size: 1,
  address: null,
  writable: true,
  section: "VAR",
  expandable: false,
  values: [],
  range: "",
  in_out: false,
};
const row = {
  kind: "value",
  key: "motor",
  path: "motor",
  root: "motor",
  level: 0,
  group: "",
  inOut: null,
  symbol: null,
};

function shows(value: number): void {
  assign("motor", 1, symbol);
  const values = new Uint8Array([value, 0, 0, 0, 0, 0, 0, 0]);
  apply({ full: false, scan: 1, timeNs: 0, ids: new Uint32Array([1]), values, strings: [] });
}

function press(key: string): boolean {
  const event = { key, ctrlKey: false, metaKey: false, shiftKey: false, currentTarget: null };
  return gridKey(event as unknown as Parameters<typeof gridKey>[0], row as unknown as ValueRow);
}

beforeEach(() => {
  vi.stubGlobal("requestAnimationFrame", () => 0);
  sent.length = 0;
  useWatches.setState({ symbols: new Map([["motor", symbol]]) });
  usePlc.setState({
    state: { state: "running", mode: "MONITOR", past: null, startable: true } as InstanceState,
    link: { state: "open", lostAt: null, attempt: 0, nextTryAt: null },
  });
});

test("Space writes the other value of a BOOL, and nothing in the past", () => {
  shows(0);
  expect(press(" ")).toBe(true);
  shows(1);
  press(" ");
  expect(sent).toMatchObject([
    { type: "write", path: "motor", value: "TRUE" },
    { type: "write", path: "motor", value: "FALSE" },
  ]);
  usePlc.setState({
    state: { state: "past", mode: "MONITOR", past: { live_scan: 9, by: "Ann" }, startable: true } as InstanceState,
  });
  press(" ");
  expect(sent).toHaveLength(2);
});

test("the menu of a BOOL writes and forces both values, whatever its value is", () => {
  shows(1);
  const items = rowMenu(row as unknown as ValueRow, () => undefined);
  for (const label of ["Write TRUE", "Write FALSE", "Force to TRUE", "Force to FALSE"]) {
    const item = items.find((each) => each.label === label);
    expect(item?.disabled, label).toBe(false);
    item?.onSelect?.();
  }
  expect(sent).toMatchObject([
    { type: "write", value: "TRUE" },
    { type: "write", value: "FALSE" },
    { type: "force", value: "TRUE" },
    { type: "force", value: "FALSE" },
  ]);
});
