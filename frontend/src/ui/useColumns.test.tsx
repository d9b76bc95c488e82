import { cleanup, render, screen } from "@testing-library/react";
import { userEvent } from "@testing-library/user-event";
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { useWidths } from "../store/page/columns";
import { t } from "../text";
import { useColumns } from "./useColumns";

beforeEach(() => localStorage.clear());
afterEach(() => {
  cleanup();
  vi.restoreAllMocks();
});

let tables = 0;

/** A table of its own: widths are kept for as long as the page is open. */
function openTable(name = `table.${++tables}`) {
  function Table() {
    const { style, head } = useColumns(useWidths(name));
    return (
      <div role="table" style={style}>
        <div className="gr h" role="row">
          {head("at", "Time")}
          {head("text", "Text")}
        </div>
      </div>
    );
  }
  const user = userEvent.setup();
  render(<Table />);
  // jsdom lays nothing out: each head is 100 pixels wide, and its content 140.
  vi.spyOn(HTMLElement.prototype, "getBoundingClientRect").mockImplementation(function (this: HTMLElement) {
    return new DOMRect(0, 0, this.style.width === "max-content" ? 140 : 100, 24);
  });
  const grip = (column: string) => screen.getByRole("separator", { name: t("column.width", { column }) });
  const width = (column: string) => screen.getByRole("table").style.getPropertyValue(`--w-${column}`);
  const kept = () => (JSON.parse(localStorage.getItem("scanbench.widths") ?? "{}") as Record<string, unknown>)[name];
  return { name, user, grip, width, kept };
}

test("a column is made wider and narrower with the arrow keys, and Delete restores its usual width", async () => {
  const { user, grip, width, kept } = openTable();
  grip("Time").focus();
  await user.keyboard("{ArrowRight}");
  expect(width("at")).toBe("minmax(40px, 116px)");
  await user.keyboard("{ArrowLeft}");
  expect(width("at")).toBe("minmax(40px, 84px)");
  expect(kept()).toEqual({ at: 84 });
  await user.keyboard("{Delete}");
  expect(width("at")).toBe("");
  expect(kept()).toEqual({});
});

test("a column is dragged at its right edge, and only while the button is held", async () => {
  const { user, grip, width } = openTable();
  await user.pointer([
    { keys: "[MouseLeft>]", target: grip("Time"), coords: { clientX: 100 } },
    { target: grip("Time"), coords: { clientX: 230 } },
    { keys: "[/MouseLeft]", target: grip("Time") },
    { target: grip("Time"), coords: { clientX: 300 } },
  ]);
  expect(width("at")).toBe("minmax(40px, 230px)");
  expect(width("text")).toBe("");
});

test("a double click and Enter make a column as wide as its content", async () => {
  const { user, grip, width } = openTable();
  await user.dblClick(grip("Time"));
  expect(width("at")).toBe("minmax(40px, 140px)");
  grip("Text").focus();
  await user.keyboard("{Enter}");
  expect(width("text")).toBe("minmax(40px, 140px)");
  expect(screen.getByText("Time").getAttribute("style")).toBeNull();
});

test("widths are kept for each table, and only numbers count as widths", async () => {
  const { name, user, grip } = openTable();
  grip("Text").focus();
  await user.keyboard("{ArrowRight}");
  cleanup();
  vi.restoreAllMocks();
  expect(openTable().width("text")).toBe("");
  cleanup();
  vi.restoreAllMocks();
  expect(openTable(name).width("text")).toBe("minmax(40px, 116px)");

  localStorage.setItem("scanbench.widths", JSON.stringify({ log: { at: "wide", text: 90 }, forces: 3, current: null }));
  vi.resetModules();
  const { useWidths: fresh } = await import("../store/page/columns");
  cleanup();
  const seen: unknown[] = [];
  const Show = () => {
    seen.push(fresh("log").widths, fresh("forces").widths);
    return null;
  };
  render(<Show />);
  expect(seen).toEqual([{ text: 90 }, {}]);
});
