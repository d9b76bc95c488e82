import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { HARDWARE, NO_HARDWARE } from "../../../logic/errors/hardware";
import { useDocuments } from "../../../store/project/documents";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { MODEL } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { HardwareKind, Problem } from "../../../wire/types";
import { HardwarePage } from "./HardwarePage";

const range = (kind: string, lowest: number, highest: number): HardwareKind => ({ kind, lowest, highest });
const FITS = [
  range("fal", 1, 511),
  range("special-io-unit", 0, 95),
  range("basic-io-unit", 0, 0),
  range("rack", 0, 1),
  range("slot", 0, 9),
];
const TEXT = `{"version": 1, "fitted": [
  {"kind": "special-io-unit", "number": 3, "rack": 0, "slot": 2, "name": "Analog inputs"},
  {"kind": "fal", "number": 42}
]}
`;
const problem = (line: number, message: string): Problem => ({
  code: "M011",
  severity: "error",
  message,
  file: HARDWARE,
  line,
  column: 1,
  end_line: line,
  end_column: 2,
});

async function openHardware(text: string | null, prepare: (server: FakeServer) => void = () => undefined) {
  let stored = text;
  const page = await openPage((server) => {
    server.on("GET", "/instances/*/model", () => ({ ...MODEL, fits: FITS }));
    server.on("GET", "/projects/*/files", () =>
      stored === null ? [] : [{ path: HARDWARE, version: 1, author: "Mika" }],
    );
    server.on("GET", "/projects/*/files/**", () => ({
      path: HARDWARE,
      version: 1,
      author: "Mika",
      text: stored ?? "",
    }));
    server.on("PUT", "/projects/*/files/**", ({ body }) => {
      stored = body.text;
      return { path: HARDWARE, version: body.version + 1, author: "Mika" };
    });
    prepare(server);
  });
  render(<HardwarePage />);
  return { ...page, saved: () => stored };
}

const now = () => useDocuments.getState().open[HARDWARE]?.text ?? "";
const kind = (name: "special-io-unit" | "fal" | "basic-io-unit") =>
  screen.findByRole("region", { name: t(`hardware.kind.${name}`) });

test("without the file it says what that means, and begins one", async () => {
  const { user, saved } = await openHardware(null);
  await screen.findByText(t("hardware.empty.about"));
  await user.click(button(t("hardware.begin")));
  await kind("fal");
  expect(saved()).toBe(NO_HARDWARE);
});

test("only the kinds of the model have a section; names and numbers are changed where the text has them", async () => {
  const { user, saved } = await openHardware(TEXT);
  const units = await kind("special-io-unit");
  expect(screen.queryByRole("region", { name: t("hardware.kind.cpu-bus-unit") })).toBeNull();
  const what = `${t("hardware.one.special-io-unit")} 3`;
  await user.type(within(units).getByRole("textbox", { name: `${what}: ${t("hardware.field.name")}` }), " 1");
  const number = within(units).getByRole("spinbutton", { name: `${what}: ${t("hardware.field.number")}` });
  await user.type(number, "5", { initialSelectionStart: 0, initialSelectionEnd: 1 });
  const changed = TEXT.replace("Analog inputs", "Analog inputs 1").replace('"number": 3', '"number": 5');
  expect(now()).toBe(changed);
  await user.keyboard("{Control>}s{/Control}");
  await waitFor(() => expect(saved()).toBe(changed));
});

test("a unit goes into an empty slot by keyboard, gets the next number, and is removed again", async () => {
  const { user } = await openHardware(TEXT);
  const slot = await screen.findByRole("button", {
    name: `${t("hardware.slot", { rack: 0, slot: 0 })}: ${t("hardware.slot.empty")}`,
  });
  slot.focus();
  await user.keyboard("{Enter}{ArrowDown}{Enter}");
  const what = `${t("hardware.one.special-io-unit")} 0`;
  expect(now()).toContain('{"kind": "special-io-unit", "number": 0, "rack": 0, "slot": 0}');
  await user.click(button(t("hardware.remove", { what })));
  expect(now()).toBe(TEXT);
});

test("what is wrong is told at its row, and what is wrong with the file above them", async () => {
  await openHardware(TEXT, (server) =>
    server.on("POST", "/projects/*/check", () => ({
      checks: [],
      tasks: [],
      pous: [],
      problems: [problem(3, "fal 42 is fitted already"), problem(1, "one too many")],
    })),
  );
  const numbers = await kind("fal");
  await waitFor(() => expect(textOf(numbers)).toContain("fal 42 is fitted already"));
  expect(textOf(await kind("special-io-unit"))).not.toContain("already");
  expect(textOf(screen.getAllByRole("alert")[0] ?? null)).toContain("one too many");
});

test("a text that is no such file is not touched: its text can be opened", async () => {
  const { user, places } = await openHardware("{");
  await screen.findByText(t("hardware.unreadable"), { exact: false });
  await user.click(button(t("hardware.openfile")));
  expect(places).toEqual([`file ${HARDWARE}`]);
});

test("the numbers that the program raises are added with a click", async () => {
  const found = (number: number, text: string) => ({ kind: "fal", number, text, file: "Main.st", line: 7 });
  const { user, server } = await openHardware(TEXT, (server) =>
    server.on("POST", "/projects/*/check", ({ body }) => ({
      checks: [],
      tasks: [],
      pous: [],
      problems: [],
      ...(body.numbers ? { numbers: [found(42, ""), found(43, "PUMP HOT"), found(44, "")] } : {}),
    })),
  );
  const offer = (what: string) => screen.findByRole("button", { name: t("hardware.used.add", { what }) });
  await user.click(await offer("FAL 43 PUMP HOT"));
  expect(now()).toContain('{"kind": "fal", "number": 42},\n  {"kind": "fal", "number": 43, "name": "PUMP HOT"}');
  await offer("FAL 44");
  expect(screen.queryByRole("button", { name: t("hardware.used.add", { what: "FAL 42" }) })).toBeNull();
  expect(server.unknown).toEqual([]);
});
