import { describe, expect, it } from "vitest";
import type { ErrorGroup, ErrorHistoryRow, ErrorInfo } from "../../wire/types";
import { type CatalogueView, catalogueRows, detailsInWords, inNames, rowFor, toggleAll } from "./catalogue";

const error = (id: string, code: string, details: ErrorInfo["details"] = []): ErrorInfo => ({
  id,
  name: id.replace("-", " "),
  description: "",
  code,
  flag: `A402.${code.slice(-1)}`,
  severity: code.startsWith("80") ? "fatal" : "nonfatal",
  priority: 1,
  verified: true,
  source: "",
  facts: [],
  details,
  absent: false,
  user: false,
});

const groups = [
  { name: "Fatal", groups: [], errors: [error("memory-error", "80F1")] },
  {
    name: "Non-fatal",
    groups: [{ name: "Units", groups: [], errors: [error("unit-error", "0300")] }],
    errors: [error("battery-error", "00F7"), error("io-error", "009A")],
  },
] satisfies [ErrorGroup, ErrorGroup];

const view = (over: Partial<CatalogueView> = {}): CatalogueView => ({
  filter: "",
  status: "all",
  severity: "all",
  reaction: "all",
  closed: new Set(),
  checked: new Set(),
  history: new Map(),
  armed: new Set(),
  ...over,
});

const history = (id: string, status: ErrorHistoryRow["status"], code = "009A") =>
  new Map([[id, { id, status, code } as ErrorHistoryRow]]);

describe("catalogueRows", () => {
  it("takes the verdict of a sweep for an error that was not raised here", () => {
    const swept = { state: "done", verdict: "no_effect", scans: null, message: "" } as const;
    const reaction = { ...swept, verdict: "acted", scans: 1 } as const;
    const told = new Map([
      ["battery-error", { id: "battery-error", status: "never", reaction: null, swept } as ErrorHistoryRow],
      ["io-error", { id: "io-error", status: "cleared", reaction, swept } as ErrorHistoryRow],
    ]);
    const rows = catalogueRows(groups, view({ history: told, armed: new Set(["unit-error"]) }));
    expect(rows.find((row) => row.key === "battery-error")).toMatchObject({ reaction: swept, swept: true });
    expect(rows.find((row) => row.key === "io-error")).toMatchObject({ reaction, swept: false, armed: false });
    expect(rows.find((row) => row.key === "unit-error")).toMatchObject({ reaction: null, swept: false, armed: true });
    expect(rows.find((row) => row.key === "/Non-fatal")).toMatchObject({ tested: 2 });
    const findings = catalogueRows(groups, view({ history: told, reaction: "findings" }));
    expect(findings.map((row) => row.key)).toEqual(["/Non-fatal", "battery-error"]);
  });

  it("shows groups, inner groups and errors with their levels", () => {
    const rows = catalogueRows(groups, view());
    expect(rows.map((row) => [row.key, row.level])).toEqual([
      ["/Fatal", 0],
      ["memory-error", 1],
      ["/Non-fatal", 0],
      ["/Non-fatal/Units", 1],
      ["unit-error", 2],
      ["battery-error", 1],
      ["io-error", 1],
    ]);
  });

  it("ticks the box of a group half when only some of its errors are ticked", () => {
    const rows = catalogueRows(groups, view({ checked: new Set(["unit-error"]) }));
    expect(rows.find((row) => row.key === "/Non-fatal")).toMatchObject({ check: "some" });
    expect(rows.find((row) => row.key === "/Non-fatal/Units")).toMatchObject({ check: "all" });
    expect(rows.find((row) => row.key === "/Fatal")).toMatchObject({ check: "none" });
  });

  it("filters by name, code and flag, and omits empty groups", () => {
    const keys = (filter: string) => catalogueRows(groups, view({ filter })).map((row) => row.key);
    expect(keys("80f1")).toEqual(["/Fatal", "memory-error"]);
    expect(keys("battery")).toEqual(["/Non-fatal", "battery-error"]);
    expect(keys("nothing of the kind")).toEqual([]);
  });

  it("also finds an error by its name in the other language", () => {
    const [plain] = groups;
    const wordings = [{ language: "ja", name: "メモリ異常", description: "" }];
    const found = (filter: string) =>
      catalogueRows([{ ...plain, errors: plain.errors.map((one) => ({ ...one, wordings })) }], view({ filter }));
    expect(found("メモリ").map((row) => row.key)).toEqual(["/Fatal", "memory-error"]);
    expect(found("memory").map((row) => row.key)).toEqual(["/Fatal", "memory-error"]);
  });

  it("filters by state and shows the raised code", () => {
    const rows = catalogueRows(
      groups,
      view({ status: "generated", history: history("io-error", "generated", "009B") }),
    );
    expect(rows).toMatchObject([
      { key: "/Non-fatal", tested: 0 },
      { key: "io-error", code: "009B" },
    ]);
  });

  it("filters by severity", () => {
    const keys = catalogueRows(groups, view({ severity: "fatal" })).map((row) => row.key);
    expect(keys).toEqual(["/Fatal", "memory-error"]);
  });

  it("counts an error as tested when its reaction is known, and filters by that", () => {
    const reacted = (id: string, verdict: string | null, state = "done") =>
      [id, { id, status: "generated", code: "", reaction: { state, verdict, scans: 1, message: "" } }] as const;
    const known = new Map([
      reacted("unit-error", "acted"),
      reacted("battery-error", "never_read"),
      reacted("io-error", null, "recording"),
    ]) as unknown as CatalogueView["history"];
    const keys = (reaction: CatalogueView["reaction"]) =>
      catalogueRows(groups, view({ reaction, history: known }))
        .filter((row) => row.kind === "error")
        .map((row) => row.key);
    expect(catalogueRows(groups, view({ history: known })).find((row) => row.key === "/Non-fatal")).toMatchObject({
      tested: 2,
      ids: ["unit-error", "battery-error", "io-error"],
    });
    expect(keys("findings")).toEqual(["battery-error"]);
    expect(keys("acted")).toEqual(["unit-error"]);
    expect(keys("unknown")).toEqual(["memory-error", "io-error"]);
  });

  it("jumps to the next row whose name, code or flag begins with the typed letters", () => {
    const rows = catalogueRows(groups, view());
    expect(rowFor(rows, "n", 0)?.key).toBe("/Non-fatal");
    expect(rowFor(rows, "ba", 0)?.key).toBe("battery-error");
    expect(rowFor(rows, "009", 0)?.key).toBe("io-error");
    expect(rowFor(rows, "m", 3)?.key).toBe("memory-error");
    expect(rowFor(rows, "xyz", 0)).toBeUndefined();
  });

  it("omits the rows of folded groups", () => {
    expect(catalogueRows(groups, view({ closed: new Set(["/Non-fatal"]) })).length).toBe(3);
  });
});

describe("toggleAll", () => {
  it("ticks all unless all are ticked", () => {
    expect([...toggleAll(["a", "b"], new Set(["a", "x"]))].sort()).toEqual(["a", "b", "x"]);
    expect([...toggleAll(["a", "b"], new Set(["a", "b", "x"]))]).toEqual(["x"]);
  });
});

describe("the details of an error", () => {
  it("are described with the texts of the catalogue, where it has some", () => {
    const details = [
      { name: "part", description: "Part", choices: [{ id: "table", description: "I/O table", address: "" }] },
      { name: "rack", description: "Rack number" },
    ] as unknown as ErrorInfo["details"];
    expect(detailsInWords(error("x", "0001", details), "part=table, rack=2")).toBe("I/O table, Rack number 2");
    expect(detailsInWords(error("x", "0001", details), "part=gone, other=1")).toBe("Part gone, other=1");
    expect(detailsInWords(undefined, "rack=2")).toBe("rack=2");
    expect(detailsInWords(undefined, "")).toBe("");
  });

  it("are named instead of numbered in messages of the server", () => {
    const details = [{ name: "rack", description: "Rack number" }] as unknown as ErrorInfo["details"];
    const errors = [error("io-error", "009A", details), error("fal", "4100")];
    expect(inNames(errors, "generated io-error (rack=2), code 009A, fal, code 4100")).toBe(
      "Generated io error (Rack number 2), code 009A, fal, code 4100",
    );
    expect(inNames(errors, "io-error: already generated by Mika")).toBe("Io error: already generated by Mika");
    expect(inNames(errors, "recovered basic-io-error (rack=2)")).toBe("Recovered basic-io-error (rack=2)");
    expect(inNames(errors, "")).toBe("");
  });
});
