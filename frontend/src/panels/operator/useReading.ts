import { useEffect, useState } from "react";
import { follow } from "../../store/plc/follow";
import { sortKey } from "../../store/plc/values";
import { useWatches } from "../../store/plc/watches";
import type { PlcSymbol } from "../../wire/types";

export interface Reading {
  /** Empty while no value is known. */
  text: string;
  /** Of a BOOL; else null. */
  on: boolean | null;
  /** Of a number; else null. */
  number: number | null;
  symbol: PlcSymbol | null;
  /** Why there is no value: the program has no such variable. */
  refused: string | null;
}

/** The live value of a variable or address, or that of the scan that is shown. */
export function useReading(path: string): Reading {
  const [{ text, on, number }, set] = useState<Pick<Reading, "text" | "on" | "number">>(NOTHING);
  const symbol = useWatches(({ symbols }) => symbols.get(path) ?? null);
  const refused = useWatches(({ refusals }) => refusals.get(path)?.message ?? null);
  useEffect(() => {
    if (path === "") return;
    const unfollow = follow(path, "default", (reading) => {
      const key = sortKey(path);
      const number = isNumber(path) && key !== null && typeof key !== "string" ? Number(key) : null;
      set((before) =>
        before.text === reading.text && before.on === reading.lamp && before.number === number
          ? before
          : { text: reading.text, on: reading.lamp, number },
      );
    });
    return () => {
      unfollow();
      set(NOTHING);
    };
  }, [path]);
  return { text, on, number, symbol, refused };
}

/** A duration or a date is no number of anything that a scale could show. */
function isNumber(path: string): boolean {
  const kind = useWatches.getState().symbols.get(path)?.kind;
  return kind === "int" || kind === "uint" || kind === "bits" || kind === "real";
}

const NOTHING = { text: "", on: null, number: null };
