import { expect, test } from "vitest";
import { BASIC, BATTERY, row } from "../../testing/catalogue";
import type { ErrorHistoryRow, ErrorInfo } from "../../wire/types";
import { byKind, keyOf } from "../plc/errorInstances";
import { isFitted, tickedToRaise, toRaise } from "./fitted";

const UNIT: ErrorInfo = {
  ...BASIC,
  details: BASIC.details.map((each) => ({ ...each, identifies: "several", hardware: "basic-io-unit" })),
};
const BOARD: ErrorInfo = { ...BATTERY, id: "inner-board-error" };
const unit = (slot: number, fitted = true) => row(UNIT, { instance: `basic-io-error:rack=0,slot=${slot}`, fitted });

function known(rows: ErrorHistoryRow[], hardware = true) {
  const instances = new Map(rows.map((each) => [keyOf(each), each]));
  return { known: hardware, instances, kinds: byKind(instances) };
}

const ROWS = [row(BATTERY), row(BOARD, { fitted: false }), unit(0), unit(3), unit(7, false)];

test("a sweep raises each instance that is fitted, and says how many errors have none", () => {
  const all = toRaise([BATTERY, BOARD, UNIT], known(ROWS));
  expect(all.keys).toEqual([BATTERY.id, "basic-io-error:rack=0,slot=0", "basic-io-error:rack=0,slot=3"]);
  expect(all.absent).toBe(1);
  expect(toRaise([BATTERY, BOARD, UNIT], known(ROWS, false))).toEqual({
    keys: [BATTERY.id, BOARD.id, UNIT.id],
    absent: 0,
  });
});

test("of what is ticked single instances are raised, and not one that was only raised anyway", () => {
  const ticked = new Set(["basic-io-error:rack=0,slot=3", "basic-io-error:rack=0,slot=7", BATTERY.id]);
  const found = tickedToRaise(ticked, [BATTERY, BOARD, UNIT], known(ROWS));
  expect(found).toEqual({ keys: [BATTERY.id, "basic-io-error:rack=0,slot=3"], absent: 1 });
});

test("what the file does not say counts as fitted; a unit that it does not have is not", () => {
  const one = (slot: string) => ({ id: UNIT.id, details: { rack: "0", slot } });
  expect(isFitted(UNIT, one("3"), known(ROWS))).toBe(true);
  expect(isFitted(UNIT, one("5"), known(ROWS))).toBe(false);
  expect(isFitted(UNIT, one("7"), known(ROWS))).toBe(false);
  expect(isFitted(UNIT, one("5"), known(ROWS, false))).toBe(true);
  expect(isFitted(BOARD, { id: BOARD.id, details: {} }, known(ROWS))).toBe(false);
  expect(isFitted(BATTERY, { id: BATTERY.id, details: {} }, known(ROWS))).toBe(true);
});
