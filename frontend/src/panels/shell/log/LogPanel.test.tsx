import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { t } from "../../../text";
import type { LogLine, LogPage } from "../../../wire/types";
import { LogPanel } from "./LogPanel";

const AT = "2026-11-24T09:00:00.000Z";
const line = (scan: number): LogLine => ({ at: AT, scan, author: "Mika", text: `event ${scan}`, kind: "error" });
const page = (first: number, total: number, size: number): LogPage => ({
  first,
  total,
  kept: 1_000_000,
  lines: Array.from({ length: size }, (_, index) => line(first + index)),
});

test("the whole log is read page by page, of one kind too, and the panel goes back to what comes live", async () => {
  const asked: string[] = [];
  const { server, user } = await openPage((server) =>
    server.on("GET", "/instances/*/log", ({ path }) => {
      const query = new URLSearchParams(path.split("?")[1]);
      const first = query.get("first");
      asked.push(`${first ?? "last"} ${query.get("kind") ?? "all"}`);
      return page(first === null ? 99_000 : Number(first), 100_000, 1000);
    }),
  );
  render(<LogPanel />);
  server.say({ type: "log", lines: [line(7)] });
  await user.click(await screen.findByRole("button", { name: t("log.whole") }));
  const said = (first: string, last: string) => t("log.page", { first, last, total: "100,000" });
  const status = await screen.findByRole("status");
  expect(textOf(status)).toBe(said("99,001", "100,000"));
  expect(button(t("log.later"))).toHaveProperty("disabled", true);
  await user.click(button(t("log.earlier")));
  await waitFor(() => expect(textOf(screen.getByRole("status"))).toBe(said("98,001", "99,000")));
  await user.click(button(t("log.filter", { kind: t("log.kind.all") })));
  await user.click(screen.getByRole("menuitemradio", { name: t("log.kind.error") }));
  await waitFor(() => expect(asked).toEqual(["last all", "98000 all", "last error"]));
  await user.click(await screen.findByRole("button", { name: t("log.live") }));
  expect(screen.queryByRole("status")).toBeNull();
  expect(button(t("log.whole"))).toBeDefined();
});
