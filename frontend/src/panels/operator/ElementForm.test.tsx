import { fireEvent, render, screen } from "@testing-library/react";
import { expect, onTestFinished, test } from "vitest";
import type { PanelElement } from "../../logic/operator/panel";
import { useOperatorPanels } from "../../store/operator/panels";
import { t } from "../../text";
import { ElementForm } from "./ElementForm";

const PATH = "Line.panel.json";

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
  const panel = { elements: [ELEMENT] };
  const open = { version: 1, base: panel, panel, wrong: null, trouble: null, kept: true };
  useOperatorPanels.setState({ open: { [PATH]: open } });
  const edits: unknown[] = [];
  const ends = useOperatorPanels.subscribe((now, before) => {
    if (now.open[PATH]?.panel !== before.open[PATH]?.panel) edits.push(now.open[PATH]?.panel);
  });
  onTestFinished(() => {
    ends();
    useOperatorPanels.setState({ open: {} });
  });
  render(<ElementForm path={PATH} element={ELEMENT} onRemoved={() => {}} />);
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
