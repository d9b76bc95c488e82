import { fireEvent, render, screen } from "@testing-library/react";
import { expect, test, vi } from "vitest";
import type { PanelElement } from "../../logic/operator/panel";
import { t } from "../../text";

const edits = vi.hoisted(() => [] as unknown[]);
vi.mock("../../store/operator/panels", () => ({ editPanel: (_path: string, change: unknown) => edits.push(change) }));

const { ElementForm } = await import("./ElementForm");

const ELEMENT: PanelElement = {
  id: "a",
  kind: "slider",
  path: "D1",
  label: "",
  low: 0,
  high: 100,
  column: 0,
  row: 0,
  width: 7,
  height: 2,
};

test("half an address is on nobody's panel: a text counts when it is entered, and Escape takes it back", () => {
  render(<ElementForm path="Line.panel.json" element={ELEMENT} onRemoved={() => {}} />);
  const variable = screen.getByRole("combobox", { name: t("operator.variable") });
  for (const text of ["D", "D10", "D100"]) fireEvent.change(variable, { target: { value: text } });
  expect(edits).toHaveLength(0);
  fireEvent.blur(variable);
  expect(edits).toHaveLength(1);

  const label = screen.getByLabelText(t("operator.label"));
  fireEvent.change(label, { target: { value: "Speed" } });
  fireEvent.keyDown(label, { key: "Escape" });
  fireEvent.blur(label);
  expect(edits).toHaveLength(1);

  const high = screen.getByLabelText(t("operator.high"));
  fireEvent.change(high, { target: { value: "5o" } });
  fireEvent.keyDown(high, { key: "Enter" });
  expect(edits).toHaveLength(1);
  fireEvent.change(high, { target: { value: "50" } });
  fireEvent.keyDown(high, { key: "Enter" });
  expect(edits).toHaveLength(2);
});
