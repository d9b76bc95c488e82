import { render, screen } from "@testing-library/react";
import { expect, test } from "vitest";
import { t } from "../../text";
import { Required } from "./Required";

test("a restart in a project that requires nothing is not told as required by it", () => {
  render(<Required required={[]} restarts={[{ path: "fan", scan: 1, allowed_by: "" }]} />);
  screen.getByRole("region", { name: t("required.restart.rule") });
  expect(screen.queryByRole("region", { name: t("required.label") })).toBeNull();
});
