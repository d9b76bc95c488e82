import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { showInMemory, useMemory } from "../../../store/watch/memory";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import { MODEL } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { MemoryWord, PlcSymbol } from "../../../wire/types";
import { MemoryPage } from "./MemoryPage";

const word = (path: string): PlcSymbol => ({
  ...{ path, name: path, type: "WORD", kind: "bits", size: 2, address: path, writable: true },
  ...{ section: "address", expandable: false, values: [], range: "", in_out: false },
});
const LEVEL: PlcSymbol = { ...word("Main.level"), type: "INT", kind: "int", address: "D12" };

function serveMemory(server: FakeServer): void {
  const area = { description: "Data", retain: true, program: "write", engine: "write" } as const;
  server.on("GET", "/instances/*/model", () => ({
    ...MODEL,
    areas: [
      { ...area, name: "CIO", words: 40, first: "CIO 0", last: "CIO 39", tool: "write" as const },
      { ...area, name: "D", words: 30, first: "D0", last: "D29", tool: "write" as const },
      { ...area, name: "D", words: 10, first: "D30", last: "D39", tool: "read" as const },
    ],
  }));
  server.on("GET", "/instances/*/memory/*/words", (_, [, , area]) =>
    Array.from(
      { length: 40 },
      (_, at): MemoryWord => ({
        address: area === "D" ? `D${at}` : `CIO ${at}`,
        symbols: area === "D" && at === 12 ? [LEVEL] : [],
      }),
    ),
  );
  for (let at = 0; at < 40; at += 1) server.has(word(`D${at}`), at === 12 ? 0x1f : 0);
  server.has(LEVEL, 0x1f);
}

async function openMemory() {
  useMemory.setState({ area: "D", selected: 0 });
  const page = await openPage(serveMemory);
  render(<MemoryPage />);
  await waitFor(() => expect(cell("D12").querySelector(".txt")?.textContent).toBe("001F"));
  return { ...page, grid: screen.getByRole("grid") };
}

const cell = (address: string) => screen.getByTestId(`memory:${address}`);
const details = (address: string) => screen.getByRole("region", { name: t("memory.word", { address }) });

test("the page opens at the address that was asked for, also when it is opened for the first time", async () => {
  useMemory.setState({ area: null, selected: 0 });
  let answer: () => void = () => undefined;
  const place = new Promise<void>((settle) => {
    answer = settle;
  });
  await openPage((server) => {
    serveMemory(server);
    server.on("GET", "/instances/*/memory", async () => {
      await place;
      return { area: "D", word: 20 };
    });
  });
  const going = showInMemory("Main.level");
  render(<MemoryPage />);
  await waitFor(() => expect(useMemory.getState().area).toBe("CIO"));
  answer();
  await going;
  await waitFor(() => expect(cell("D20").getAttribute("aria-selected")).toBe("true"));
});

test("a word is chosen by keys, its details name the variables in it, and it is written in the format of the grid", async () => {
  const { server, user, grid } = await openMemory();
  grid.focus();
  await user.keyboard("{ArrowDown}{ArrowRight}{ArrowRight}");
  expect(grid.getAttribute("aria-activedescendant")).toBe(cell("D12").id);
  await waitFor(() => expect(details("D12").textContent).toContain("Main.level"));
  await waitFor(() => expect(details("D12").textContent).toContain("2#0000000000011111"));
  await user.keyboard("2a{Enter}");
  await waitFor(() => expect(server.sentOf("write")).toMatchObject([{ path: "D12", value: "42" }]));
  expect(document.activeElement).toBe(grid);
  await user.keyboard("7{Escape}");
  expect(server.sentOf("write")).toHaveLength(1);
});

test("a refused write says why; a part that tools may not write says so before", async () => {
  const { server, user, grid } = await openMemory();
  server.command("write", () => "D0 is read-only for tools");
  grid.focus();
  await user.keyboard("5{Enter}");
  await waitFor(() => expect(screen.getByRole("alert").textContent).toBe("D0 is read-only for tools"));
  expect(screen.getByRole("textbox", { name: t("memory.change", { address: "D0" }) })).toHaveProperty("value", "5");
  await user.keyboard("{Escape}{Control>}{End}{/Control}");
  await waitFor(() => expect(details("D39").textContent).toContain(t("memory.readonly")));
});

test("a value is found from the selected word on, and from the start again; an address is gone to", async () => {
  const { server, user } = await openMemory();
  server.on("GET", "/instances/*/memory/*/find", ({ path }) => ({
    scan: 7,
    words: path.endsWith("first=1") ? [12] : path.endsWith("first=13") ? [] : [3],
    more: false,
  }));
  await user.type(screen.getByRole("textbox", { name: t("memory.find") }), "1F{Enter}");
  await waitFor(() => expect(cell("D12").getAttribute("aria-selected")).toBe("true"));
  expect(screen.getByRole("status").textContent).toBe(t("memory.found", { when: t("memory.when.scan", { scan: 7 }) }));
  await user.type(screen.getByRole("textbox", { name: t("memory.find") }), "{Enter}");
  await waitFor(() => expect(cell("D3").getAttribute("aria-selected")).toBe("true"));
  expect(screen.getByRole("status").textContent).toBe(t("memory.again", { when: t("memory.when.scan", { scan: 7 }) }));
  await user.type(screen.getByRole("textbox", { name: t("memory.find") }), "xyz{Enter}");
  await waitFor(() => expect(screen.getByRole("alert").textContent).toContain("1Fxyz"));

  server.on("GET", "/instances/*/memory", () => ({ area: "D", word: 20 }));
  await user.type(screen.getByRole("combobox", { name: t("memory.goto") }), "D20{Enter}");
  await waitFor(() => expect(cell("D20").getAttribute("aria-selected")).toBe("true"));
  server.on("GET", "/instances/*/memory", () => refusal("there is no such address"));
  await user.type(screen.getByRole("combobox", { name: t("memory.goto") }), "x{Enter}");
  await waitFor(() => expect(screen.getByRole("alert").textContent).toBe("there is no such address"));
});
