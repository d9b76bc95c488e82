/** Campaigns of disturbances on the run of the selected PLC: the form, their progress, and what came of each disturbance. */

import { create } from "zustand";
import { messageOf } from "../../logic/format/messageOf";
import { grouped } from "../../logic/format/numbers";
import { type CampaignForm, FORM, MOST_TRIALS, type Shown, wantedOf } from "../../logic/verify/campaign";
import { t } from "../../text";
import { campaigns } from "../../wire/campaigns";
import type { CampaignState, CampaignTrial } from "../../wire/types";
import { openPage } from "../page/navigate";
import { refreshApp, useBench } from "../plc/bench";
import { openInstance } from "../plc/instances";
import { useLinks } from "../plc/links";

interface Campaigns {
  form: CampaignForm;
  /** Those of the selected instance, the newest first. */
  list: readonly CampaignState[];
  /** Id of the chosen one; null: the newest. */
  chosen: number | null;
  trials: { of: number; all: readonly CampaignTrial[] } | null;
  /** Only those that ended like this are listed. */
  shown: Shown;
  /** The disturbance that is being opened. */
  opening: number | null;
  trouble: string | null;
}

const nothing = { list: [], chosen: null, trials: null, shown: null, opening: null, trouble: null };

export const useCampaigns = create<Campaigns>(() => ({ form: FORM, ...nothing }));
const get = useCampaigns.getState;
const set = useCampaigns.setState;

export const showCampaigns = () => openPage("campaign");
export const changeForm = (changed: Partial<CampaignForm>) => set(({ form }) => ({ form: { ...form, ...changed } }));
export const showOutcome = (shown: Shown) => set({ shown });

/** The chosen one, else the newest. */
export const shownCampaign = ({ list, chosen }: Campaigns): CampaignState | null =>
  list.find(({ id }) => id === chosen) ?? list[0] ?? null;

export function chooseCampaign(id: number): void {
  set({ chosen: id, shown: null });
  fetchTrials();
}

/** Begins what the form asks for. */
export async function beginCampaign(): Promise<void> {
  const wanted = wantedOf(get().form);
  if (wanted === null) {
    set({ trouble: t("campaign.bad") });
    return;
  }
  if (wanted.count < 1 || wanted.count > MOST_TRIALS) {
    set({ trouble: t("campaign.bad.count", { most: grouped(MOST_TRIALS) }) });
    return;
  }
  await guarded(async (instance) => {
    const { id } = await campaigns.begin(instance, wanted);
    set({ chosen: id, shown: null });
    fetchTrials();
  });
}

/** Cancels a running one, deletes a finished one. */
export const forgetCampaign = (id: number) =>
  guarded(async () => {
    await campaigns.forget(id);
    set(({ list, chosen }) => ({
      list: list.filter((known) => known.id !== id),
      chosen: chosen === id ? null : chosen,
    }));
    fetchTrials();
  });

/** A new paused PLC with the run as this disturbance made it; the page goes to the scan in which it came, to be verified there. */
export const openTrial = (id: number, number: number, scan: number) =>
  guarded(async () => {
    set({ opening: number });
    try {
      const made = await campaigns.open(id, number);
      await refreshApp();
      useLinks.setState({ opened: { instance: made.id, scan, panel: "verify" } });
      openInstance(made);
    } finally {
      set({ opening: null });
    }
  });

/** After each connection: fetches what the socket missed. */
export const refreshCampaigns = () =>
  guarded(async (instance) => {
    const list = await campaigns.list(instance);
    if (useBench.getState().instance?.id !== instance) return;
    set({ list });
    fetchTrials();
  });

/** Why is shown until there is a next one, as the server has it. */
const cameToNothing = ({ over, message, done }: CampaignState) => over && message !== "" && done === 0;

/** The progress of one of the selected instance. */
export function onCampaign(campaign: CampaignState): void {
  if (campaign.instance !== useBench.getState().instance?.id) return;
  const kept = (each: CampaignState) => each.id !== campaign.id && !(each.id < campaign.id && cameToNothing(each));
  set(({ list }) => ({ list: [campaign, ...list.filter(kept)].sort((a, b) => b.id - a.id) }));
  if (campaign.id === shownCampaign(get())?.id) fetchTrials();
}

let fetching = false;
let again = false;

/** What came of the shown one so far; one request at a time. */
function fetchTrials(): void {
  const id = shownCampaign(get())?.id;
  if (id === undefined) return;
  again = fetching;
  if (fetching) return;
  fetching = true;
  void campaigns
    .whole(id)
    .then(({ trials }) => {
      if (shownCampaign(get())?.id === id) set({ trials: { of: id, all: trials } });
    })
    .catch(() => undefined) // it was deleted meanwhile
    .finally(() => {
      fetching = false;
      if (again) fetchTrials();
    });
}

async function guarded(deed: (instance: number) => Promise<void>): Promise<void> {
  const instance = useBench.getState().instance?.id;
  if (instance === undefined) return;
  try {
    set({ trouble: null });
    await deed(instance);
  } catch (error) {
    set({ trouble: messageOf(error) });
  }
}

useBench.subscribe((now, before) => {
  if (now.instance?.id !== before.instance?.id) set(nothing);
});
