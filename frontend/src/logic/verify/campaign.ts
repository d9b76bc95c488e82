/** What the form of a campaign asks for, and which of its disturbances are listed. */
import type { CampaignTrial, NewCampaign } from "../../wire/types";

type Kind = CampaignTrial["kind"];
export type Outcome = CampaignTrial["outcome"];
/** `silent`: an output was wrong, and the program did not notice it. */
export type Shown = Outcome | "silent" | null;

export const KINDS: readonly Kind[] = ["flip", "result", "stuck", "late"];

export interface CampaignForm {
  count: string;
  seed: string;
  first: string;
  last: string;
  window: string;
  /** Conditions, separated by semicolons. */
  alarms: string;
  kinds: readonly Kind[];
}

/** Empty scans: the last 500 of the run. */
export const FORM: CampaignForm = {
  count: "100",
  seed: "1",
  first: "",
  last: "",
  window: "100",
  alarms: "",
  kinds: KINDS,
};

/** Disturbances of one campaign, as the server wants it. */
export const MOST_TRIALS = 2000;

/** The request; null where a number is none. */
export function wantedOf(form: CampaignForm): NewCampaign | null {
  const count = whole(form.count);
  const seed = whole(form.seed);
  const window = whole(form.window);
  const first = form.first.trim() === "" ? null : whole(form.first);
  const last = form.last.trim() === "" ? null : whole(form.last);
  if (count === undefined || seed === undefined || window === undefined) return null;
  if (first === undefined || last === undefined || form.kinds.length === 0) return null;
  const alarms = form.alarms
    .split(";")
    .map((each) => each.trim())
    .filter(Boolean);
  return { count, seed, window, first, last, kinds: [...form.kinds], alarms };
}

const whole = (text: string): number | undefined =>
  /^\d{1,15}$/.test(text.replace(/[\s,]/g, "")) ? Number(text.replace(/[\s,]/g, "")) : undefined;

/** Silent: an output was wrong, and the program did not notice it. */
export const isSilent = ({ output_scan, program }: CampaignTrial): boolean =>
  output_scan !== null && output_scan !== undefined && program.length === 0;

/** Those that ended like this. */
export const shownOf = (trials: readonly CampaignTrial[], shown: Shown): readonly CampaignTrial[] =>
  shown === null ? trials : trials.filter((trial) => (shown === "silent" ? isSilent(trial) : trial.outcome === shown));
