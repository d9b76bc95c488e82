import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { build } from "../../../store/project/documents";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { OnlineChange as Change } from "../../../wire/types";
import { OnlineChange } from "./OnlineChange";

const LOST = { path: "Main.shift", reason: "its type was INT and is TIME" };
const change = (instance: number, name: string, more: Partial<Change> = {}): Change => ({
  instance,
  name,
  kept: 58,
  reinitialized: 1,
  new: 0,
  removed: 0,
  lost: [LOST],
  lost_count: 1,
  refusal: "",
  ...more,
});

/** A build that asks about these PLCs, and is done once it is agreed to. */
async function askAbout(changes: Change[]) {
  const page = await openPage((server) =>
    server.on("POST", "/projects/*/build", ({ body: { agreed } }) => {
      const { project } = server.instance;
      return { ok: agreed, needs_agreement: !agreed, message: "", changes, pous: [], problems: [], project };
    }),
  );
  render(<OnlineChange />);
  void build();
  const dialog = await screen.findByRole("dialog");
  const builds = () => page.server.askedOf("POST", `/projects/${page.server.instance.project.id}/build`);
  return { ...page, dialog, builds };
}

const tick = (name: string) => screen.getByRole<HTMLInputElement>("checkbox", { name: t("change.choose", { name }) });
const gone = () => waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
const fate = (plc: string) => screen.getByRole("table", { name: `${plc}: ${t("change.fate.reinitialized")}` });

test("what is reinitialized is listed with the reason; nothing is built without a yes", async () => {
  const { user, dialog, builds } = await askAbout([change(1, "line-1")]);
  expect(textOf(dialog)).toContain(t("change.kept", { count: 58 }));
  expect(textOf(fate("line-1"))).toContain("Main.shift");
  expect(textOf(fate("line-1"))).toContain("its type was INT and is TIME");
  await user.click(button(t("cancel"), dialog));
  await gone();
  expect(builds()).toMatchObject([{ agreed: false }]);
});

test("with two PLCs one chooses which is changed; with none there is nothing to agree to", async () => {
  const { user, dialog, builds } = await askAbout([change(1, "line-1"), change(2, "What-If")]);
  await user.click(tick("line-1"));
  await user.click(tick("What-If"));
  expect(button(t("change.do.none"), dialog)).toHaveProperty("disabled", true);
  await user.click(tick("What-If"));
  await user.click(within(dialog).getByRole("button", { name: /What-If/ }));
  await gone();
  expect(builds().at(-1)).toMatchObject({ agreed: true, instances: [2] });
});

test("one in RUN is not changed, and says why; the other one is", async () => {
  const refused = "The PLC is in mode RUN";
  const { user, dialog, builds } = await askAbout([
    change(1, "line-1", { refusal: refused, lost: [], lost_count: 0 }),
    change(2, "What-If"),
  ]);
  expect(tick("line-1").disabled).toBe(true);
  expect(tick("What-If").checked).toBe(true);
  expect(textOf(dialog)).toContain(t("change.refused", { why: refused }));
  await user.click(within(dialog).getByRole("button", { name: /What-If/ }));
  await gone();
  // The server is told of both: it says why the one was left out.
  expect(builds().at(-1)).toMatchObject({ agreed: true, instances: [1, 2] });
});

test("where no PLC can be changed there is only a way out", async () => {
  const { user, dialog } = await askAbout([change(1, "line-1", { refusal: "The PLC is in mode RUN" })]);
  expect(within(dialog).queryByRole("button", { name: /line-1/ })).toBeNull();
  await user.click(
    within(dialog)
      .getAllByRole("button", { name: t("close") })
      .at(-1) as HTMLElement,
  );
  await gone();
});
