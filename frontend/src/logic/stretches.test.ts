import { describe, expect, it } from "vitest";
import type { ErrorInfo, Mark } from "../wire/types";
import { pieces, stretches } from "./stretches";

const error = (id: string, severity: ErrorInfo["severity"]): ErrorInfo => ({ id, severity }) as ErrorInfo;
const ERRORS = [error("memory-error", "fatal"), error("io-bus", "fatal"), error("battery", "nonfatal")];
const at = (scan: number, kind: Mark["kind"], text: string): Mark => ({ scan, kind, author: "Ann", text });
const tones = (...marks: Mark[]) => stretches(marks, ERRORS).map(({ from, tone }) => [from, tone]);

describe("stretches", () => {
  it("run before the first mark, and follow the mode", () => {
    expect(tones()).toEqual([[0, "running"]]);
    expect(
      tones(
        at(10, "mode", "mode PROGRAM: the program is stopped"),
        at(20, "mode", "mode MONITOR: the program runs"),
        at(30, "mode", "mode RUN: the program goes on"),
      ),
    ).toEqual([
      [0, "running"],
      [10, "stopped"],
      [20, "running"],
    ]);
  });

  it("are fatal from a trap to the restart, the mended program, or PROGRAM", () => {
    const trap = at(10, "system", "Main.st:9:14: division by zero (scan 10)");
    for (const way of [
      at(20, "run", "cold start: everything has its initial value"),
      at(20, "build", "program version 2: warm start, as the old"),
    ])
      expect(tones(trap, way)).toEqual([
        [0, "running"],
        [10, "fatal"],
        [20, "running"],
      ]);
    const stands = at(10, "error", "generated memory-error; the program is stopped");
    expect(tones(trap, stands, at(20, "build", "program version 2: warm start, as")).at(-1)).toEqual([20, "running"]);
    expect(tones(trap, at(15, "build", "program version 2: 3 kept")).at(-1)).toEqual([10, "fatal"]);
    expect(tones(trap, at(20, "mode", "mode PROGRAM: the program is stopped")).at(-1)).toEqual([20, "stopped"]);
    expect(tones(at(10, "system", "clock set to 2026-01-01T00:00:00"))).toEqual([[0, "running"]]);
  });

  it("are fatal while a fatal error is present, then stopped until the mode is set", () => {
    expect(
      tones(
        at(5, "error", "generated battery"),
        at(10, "error", "generated memory-error (location=a), io-bus; the program is stopped"),
        at(20, "recover", "recovered battery"),
        at(25, "recover", "recovered io-bus"),
        at(30, "recover", "recovered memory-error; the program stays stopped: change to MONITOR or RUN, or restart"),
        at(40, "mode", "mode MONITOR: the program runs"),
      ),
    ).toEqual([
      [0, "running"],
      [10, "fatal"],
      [30, "stopped"],
      [40, "running"],
    ]);
  });

  it("do not trust the end of a long text, which is cut", () => {
    const cut = at(30, "recover", "recovered memory-error, io-bus, and ma");
    expect(tones(at(10, "error", "generated memory-error, io-bus, ba"), cut).at(-1)).toEqual([30, "stopped"]);
  });
});

describe("pieces", () => {
  const axis = { from: 0, to: 1000 };

  it("lie side by side, inside of what is shown", () => {
    const run = stretches(
      [at(400, "mode", "mode PROGRAM: the program is stopped"), at(600, "mode", "mode RUN: the program runs")],
      ERRORS,
    );
    expect(pieces(run, axis, 100)).toEqual([
      { left: 0, width: 40, tone: "running" },
      { left: 40, width: 20, tone: "stopped" },
      { left: 60, width: 40, tone: "running" },
    ]);
    expect(pieces(run, { from: 450, to: 550 }, 100)).toEqual([{ left: 0, width: 100, tone: "stopped" }]);
  });

  it("show a trap that was mended at once, and are no more than there are pixels", () => {
    const marks = Array.from({ length: 1000 }, (_, scan) => [
      at(scan, "system", "Main.st:1:1: x (scan 1)"),
      at(scan, "run", "warm start"),
    ]).flat();
    const drawn = pieces(stretches(marks, ERRORS), axis, 100);
    expect(drawn.length).toBeLessThanOrEqual(50);
    expect(drawn.every(({ tone }) => tone === "fatal")).toBe(true);
    const one = pieces(stretches(marks.slice(1000, 1002), ERRORS), axis, 100);
    expect(one.map(({ tone }) => tone)).toEqual(["running", "fatal", "running"]);
  });
});
