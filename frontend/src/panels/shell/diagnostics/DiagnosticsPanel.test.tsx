import { render, screen, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { useNavigation } from "../../../store/page/navigate";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { Violation } from "../../../wire/types";
import { DiagnosticsPanel } from "./DiagnosticsPanel";

const LEFT: Violation = {
  file: "Weigh.st",
  line: 4,
  column: 1,
  end_line: 4,
  end_column: 2,
  pou: "Weigh",
  instance: "",
  variable: "r",
  target: "",
  value: "12",
  beyond: false,
  low: "0",
  high: "10",
  text: "",
  times: 1,
  first_scan: 3,
  last_scan: 3,
  calls: [
    { pou: "Main", instance: "Main", method: "", file: "Main.st", line: 16, column: 2 },
    { pou: "Half", instance: "", method: "", file: "Half.st", line: 2, column: 9 },
  ],
  cut: true,
};

test("a violation in a FUNCTION shows who called it, and a click goes to the call", async () => {
  const { server, user } = await openPage();
  render(<DiagnosticsPanel />);
  server.say({ type: "diagnostics", count: 1, dropped: 0, violations: [LEFT] });
  const entry = within(await screen.findByRole("listitem"));
  expect(entry.getByTitle(t("diagnostics.cut"))).toBeDefined();
  expect(entry.getAllByRole("button").map((each) => each.textContent)).toEqual([
    expect.stringContaining("r was 12"),
    "Main Main.st:16",
    "Half Half.st:2",
  ]);
  await user.click(entry.getByRole("button", { name: "Half Half.st:2" }));
  expect(useNavigation.getState().place).toMatchObject({ path: "Half.st", line: 2, column: 9 });
});
