import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { box, button } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { CampaignState, CampaignTrial } from "../../../wire/types";
import { CampaignPage } from "./CampaignPage";

const TRIAL: CampaignTrial = {
  number: 1,
  text: "Memory Main.n, bit 3, once in scan 500",
  kind: "flip",
  scan: 500,
  outcome: "verification",
  verification: "Main.n is 8, and should be 0",
  verified_scan: 500,
  place: { task: "Main", instance: "Main", pou: "Main", file: "Main.st", line: 7, text: "n := n + 1;" },
  program: [],
  program_scan: null,
  output_scan: 503,
  differs: true,
  trapped: false,
  refused: [],
  unvalued: [],
  why: "",
};
const TRIALS: CampaignTrial[] = [
  TRIAL,
  { ...TRIAL, number: 2, scan: 600, outcome: "both", program: ["`Main.alarm` held"], program_scan: 601 },
  {
    ...TRIAL,
    number: 3,
    outcome: "missed",
    verification: "",
    place: null,
    output_scan: null,
    why: "the statement did not run",
  },
];

test("a campaign is begun, told as it goes, filtered, and each of its disturbances leads to its scan", async () => {
  const state = (instance: number, more: Partial<CampaignState>): CampaignState => ({
    type: "campaign",
    id: 4,
    instance,
    by: "Ann",
    wanted: { seed: 9, count: 3, first: 400, last: 900, window: 50, kinds: ["flip"], alarms: ["Main.alarm"] },
    done: 0,
    of: 3,
    outcomes: [],
    silent: 0,
    over: false,
    message: "",
    ...more,
  });
  const { server, user } = await openPage((server) => {
    server.on("POST", "/instances/*/campaigns", () => state(server.instance.id, {}));
    server.on("GET", "/campaigns/*", () => ({ state: state(server.instance.id, {}), trials: TRIALS }));
  });
  render(<CampaignPage />);
  await user.clear(box(t("campaign.seed")));
  await user.click(button(t("campaign.do")));
  expect((await screen.findByRole("alert")).textContent).toBe(t("campaign.bad"));
  await user.type(box(t("campaign.seed")), "9");
  await user.clear(box(t("campaign.count")));
  await user.type(box(t("campaign.count")), "0");
  await user.click(button(t("campaign.do")));
  await screen.findByText(t("campaign.bad.count", { most: "2,000" }));
  expect(server.askedOf("POST", `/instances/${server.instance.id}/campaigns`)).toEqual([]);
  await user.clear(box(t("campaign.count")));
  await user.type(box(t("campaign.count")), "3");
  await user.type(box(t("campaign.alarms")), "Main.alarm");
  await user.click(button(t("campaign.do")));
  server.say(
    state(server.instance.id, {
      done: 3,
      silent: 1,
      over: true,
      outcomes: [
        { outcome: "both", count: 1 },
        { outcome: "verification", count: 1 },
        { outcome: "missed", count: 1 },
      ],
    }),
  );
  const table = await screen.findByRole("table", { name: t("campaign.trials") });
  const rows = () => [...table.querySelectorAll("[data-trial]")].map((row) => row.getAttribute("data-trial"));
  await waitFor(() => expect(rows()).toEqual(["1", "2", "3"]));
  await user.click(button(`${t("campaign.silent")} 1`));
  expect(rows()).toEqual(["1"]);
  expect(table.textContent).toContain(t("campaign.output", { scan: 503 }));
  await user.click(within(table).getByRole("button", { name: "500" }));
  await waitFor(() => expect(server.sentOf("travel")).toMatchObject([{ scan: 500 }]));
  await user.click(button(`${t("campaign.is.missed")} 1`));
  expect(table.textContent).toContain("the statement did not run");
  expect(within(table).queryByRole("button", { name: t("campaign.open.of", { number: 3 }) })).toBeNull();
});
