import { type KeyboardEvent, useState } from "react";
import { afterKey } from "../../../../logic/graphic/keys";
import { elementAt, replace } from "../../../../logic/graphic/ladderEdit";
import type { Place } from "../../../../logic/graphic/ladderLayout";
import type { DrawnPart, DrawnRung } from "../../../../logic/graphic/sheet";
import type { Element, Path } from "../../../../logic/graphic/tree";
import { t } from "../../../../text";
import { addRungBelow, takeBack, writePath } from "./write";

export interface Cursor {
  rung: number;
  place: Place;
}

/** An element whose field is open. Its rung is drawn from here, and written once it has a name. */
interface Naming {
  rung: number;
  path: Path;
  place: Place;
}

/** Edits rungs by keys; `go` moves the cursor. */
export function useEditing(path: string, drawn: readonly DrawnPart[], readOnly: boolean, go: (to: Cursor) => void) {
  const [naming, setNaming] = useState<Naming | null>(null);
  const [refused, setRefused] = useState("");

  /** Whether the key edits. */
  function onKey(event: KeyboardEvent, { rung: at, place: wanted }: Cursor): boolean {
    const rung = drawn[at];
    if (!rung || readOnly) return false;
    if (rung.kind !== "rung") return event.ctrlKey && undone(event.key.toLowerCase());
    if (event.ctrlKey) return withControl(event.key.toLowerCase(), at, rung);
    if (rung.path === null) return false;
    // The element at the cursor may be gone: somebody else edits the same rung.
    const place = wanted.length % 2 === 0 || elementAt(rung.path, wanted) ? wanted : [];
    const made = afterKey(event.key, rung.path, place);
    const names = event.key === "Enter" || event.key === "F2";
    if (!made && !names) return false;
    setRefused(rung.comments ? t("graphic.comments") : "");
    if (rung.comments) return true;
    if (!made) setNaming(elementAt(rung.path, place) ? { rung: at, path: rung.path, place } : null);
    else if (made.fresh) setNaming({ rung: at, path: made.path, place: made.place });
    else writePath(path, rung.found, made.path);
    if (made) go({ rung: at, place: made.place });
    return true;
  }

  function withControl(key: string, at: number, rung: DrawnRung): boolean {
    if (key === "i") {
      addRungBelow(path, rung.found);
      go({ rung: at + 1, place: [] });
    } else return undone(key);
    return true;
  }

  function undone(key: string): boolean {
    if (key !== "z" && key !== "y") return false;
    takeBack(path, key === "y");
    return true;
  }

  function take(element: Element): void {
    const rung = naming && drawn[naming.rung];
    if (naming && rung) writePath(path, rung.found, replace(naming.path, naming.place, element));
    setNaming(null);
  }

  return { naming, refused, onKey, take, leave: () => setNaming(null) };
}
