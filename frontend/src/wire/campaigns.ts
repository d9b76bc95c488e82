/** Campaigns of disturbances: the routes of `web/routes/campaigns.py`. */
import { json, request } from "./rest";
import type { CampaignState, Instance, NewCampaign, WholeCampaign } from "./types";

export const campaigns = {
  list: (instance: number) => json<CampaignState[]>("GET", `/instances/${instance}/campaigns`),
  begin: (instance: number, wanted: NewCampaign) =>
    json<CampaignState>("POST", `/instances/${instance}/campaigns`, wanted),
  whole: (campaign: number) => json<WholeCampaign>("GET", `/campaigns/${campaign}`),
  /** Cancels a running one, deletes a finished one. */
  forget: async (campaign: number): Promise<void> => {
    await request("DELETE", `/campaigns/${campaign}`);
  },
  open: (campaign: number, number: number) => json<Instance>("POST", `/campaigns/${campaign}/trials/${number}/open`),
};
