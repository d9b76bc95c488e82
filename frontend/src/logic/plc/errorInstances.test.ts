import { describe, expect, it } from "vitest";
import { BASIC, row } from "../../testing/catalogue";
import { byKind, instancesByKind, keyOf, wantedOf, withRows } from "./errorInstances";

const UNIT = { ...BASIC, id: "special-io-unit-error" };
const unit = (number: number, more: Parameters<typeof row>[1] = {}) =>
  row(UNIT, { instance: `${UNIT.id}:unit=${number}`, details: `unit=${number}`, ...more });

describe("rows of instances", () => {
  it("take the place of the row of their kind, in the order of their numbers", () => {
    const kind = withRows(new Map(), [row(UNIT), row(BASIC)]);
    expect([...kind.keys()]).toEqual([UNIT.id, BASIC.id]);
    const rows = withRows(kind, [unit(20), unit(3)]);
    expect([...rows.keys()]).toEqual([BASIC.id, `${UNIT.id}:unit=20`, `${UNIT.id}:unit=3`]);
    expect(instancesByKind(rows).get(UNIT.id)?.map(keyOf)).toEqual([`${UNIT.id}:unit=3`, `${UNIT.id}:unit=20`]);
  });

  it("are one row for the kind, which is present while one of them is", () => {
    const raised = { status: "generated", count: 2, generated_scan: 5 } as const;
    const rows = withRows(new Map(), [unit(3, raised), unit(7, { status: "cleared", count: 1, generated_scan: 9 })]);
    expect(byKind(rows).get(UNIT.id)).toMatchObject({ status: "generated", details: "unit=3", count: 3 });
    const later = withRows(rows, [unit(3, { ...raised, status: "cleared" })]);
    expect(byKind(later).get(UNIT.id)).toMatchObject({ status: "cleared", details: "unit=7" });
  });

  it("say what raises just one of them", () => {
    expect(wantedOf("io-bus-error:rack=1,slot=3")).toEqual({ id: "io-bus-error", details: { rack: "1", slot: "3" } });
  });
});
