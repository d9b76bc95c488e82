import { render, screen, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { box, button } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { NewWhatIf, WhatIf, WhatIfTry } from "../../../wire/types";
import { WhatIfPage } from "./WhatIfPage";

const TRY: WhatIfTry = {
  values: [],
  met: null,
  unvalued: null,
  output_scan: null,
  shown: ["0"],
  trapped: "",
  refused: [],
  ran: 101,
  compared: 101,
};

test("the smallest change is asked for, marked among what was tried, and a refusal keeps what was typed", async () => {
  const asked: NewWhatIf[] = [];
  const { user } = await openPage((server) => {
    server.on("POST", "/instances/*/what-if", ({ body }): WhatIf => {
      asked.push(body);
      return {
        wanted: {
          ...body,
          values: [],
          vary: "",
          tried: [],
          candidates: ["speed"],
          hold: true,
          window: 100,
          watch: ["n"],
          search: true,
          condition: "motor",
        },
        recorded: TRY,
        undisturbed: { ...TRY, shown: ["7"] },
        tries: [
          { ...TRY, values: [{ path: "speed", value: "32" }] },
          { ...TRY, values: [{ path: "speed", value: "37" }], met: 20, output_scan: 21, shown: ["4"] },
        ],
        best: 1,
        note: "it ended after 200 tries: there may be a smaller change",
        scenario: "scans: 30\n",
      };
    });
  });
  render(<WhatIfPage />);
  await user.click(screen.getByRole("radio", { name: t("whatif.mode.search") }));
  await user.type(box(t("whatif.scan")), "20");
  await user.type(box(t("whatif.candidates")), "speed");
  await user.click(button(t("whatif.do")));
  expect((await screen.findByRole("alert")).textContent).toContain(t("whatif.condition"));
  await user.type(box(t("whatif.condition")), "motor");
  await user.type(box(t("whatif.watch")), "n");
  await user.click(button(t("whatif.do")));
  const table = await screen.findByRole("table", { name: t("whatif.results") });
  expect(asked).toMatchObject([{ scan: 20, search: true, candidates: ["speed"], condition: "motor", watch: ["n"] }]);
  const [, recorded, undisturbed, first, second] = within(table).getAllByRole("row");
  expect(recorded?.textContent).toContain(t("whatif.recorded"));
  expect(undisturbed?.textContent).toContain(t("whatif.undisturbed"));
  expect(undisturbed?.textContent).toContain(t("whatif.output.same"));
  expect(first?.textContent).toContain(t("whatif.met.not"));
  expect(second?.textContent).toContain(t("whatif.best"));
  expect(second?.textContent).toContain(t("whatif.met", { scan: "20" }));
  expect(screen.getByText(/there may be a smaller change/)).toBeDefined();
  expect(button(t("whatif.test"))).toBeDefined();
});
