/** The help that is shown, and where one was before. */
import { create } from "zustand";
import { CONTENTS } from "../../logic/page/help";
import { openPage } from "./navigate";

/** Places, the best first: the first one that there is counts. */
type Wanted = readonly string[];

interface Help {
  trail: readonly Wanted[];
  at: number;
  /** What is looked for; empty: a page is shown. */
  search: string;
}

export const useHelp = create<Help>(() => ({ trail: [[CONTENTS]], at: 0, search: "" }));

/** Shows the first of these places, in the panel of the help. */
export function showHelp(...wanted: Wanted): void {
  openPage("help");
  goTo(wanted);
}

export function goTo(wanted: Wanted): void {
  useHelp.setState(({ trail, at }) => ({
    trail: [...trail.slice(0, at + 1), wanted].slice(-50),
    at: Math.min(at + 1, 49),
    search: "",
  }));
}

export function goInTrail(by: 1 | -1): void {
  useHelp.setState(({ trail, at }) => ({ at: Math.max(0, Math.min(trail.length - 1, at + by)), search: "" }));
}

export const searchHelp = (search: string) => useHelp.setState({ search });
