import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { drag, dropText } from "../../../testing/drag";
import { box, button, choose, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { JO, symbol } from "../../../testing/samples";
import { t } from "../../../text";
import { WatchPanel } from "./WatchPanel";

const PATHS = ["Main.total", "level", "Main.beat", "motor"];

const table = () => screen.getByRole("treegrid", { name: t("watch.table") });
const line = (path: string) => document.querySelector(`[data-path="${path}"] .name`) as Element;
const group = (name: string) => within(table()).getByText(name).closest("[role=row]") as HTMLElement;
const rows = () => [...document.querySelectorAll<HTMLElement>("[data-path]")];
/** The paths from top to bottom, as the rows count themselves. */
const inOrder = () =>
  rows()
    .sort((one, other) => Number(one.dataset.index) - Number(other.dataset.index))
    .map(({ dataset }) => dataset.path);
const lists = (paths: readonly string[]) => waitFor(() => expect(inOrder()).toEqual(paths));

/** A list of four variables, pasted as four lines. */
async function openList() {
  const page = await openPage((server) => {
    server.has(symbol("Main.total", "INT"), 7);
    server.has(symbol("level", "INT"), 3);
    server.has(symbol("Main.beat", "BOOL"));
    server.has(symbol("motor", "BOOL"));
    server.has(symbol("lamp", "BOOL"));
    server.has(symbol("D8", "WORD", { address: "D8" }));
  });
  render(<WatchPanel />);
  await page.user.click(screen.getByRole("combobox", { name: t("watch.add") }));
  await page.user.paste(PATHS.join("\n"));
  await lists(PATHS);
  return page;
}

async function newGroup(user: Awaited<ReturnType<typeof openPage>>["user"], name: string) {
  await choose(user, t("watch.csv"), t("watch.group.new"));
  await user.type(box(t("watch.group.name")), `${name}{Enter}`);
  await waitFor(() => expect(group(name)).not.toBeNull());
}

test("rows are dragged into a group, within it, and out of it; a group folds; a name from elsewhere is dropped", async () => {
  const { server, user } = await openList();
  await newGroup(user, "Belt");
  drag(line("motor"), group("Belt"));
  await waitFor(() => expect(textOf(group("Belt"))).toContain("1"));
  drag(line("Main.total"), line("motor"));
  await lists(["level", "Main.beat", "Main.total", "motor"]);

  await user.click(button(t("watch.fold", { path: "Belt" })));
  await lists(["level", "Main.beat"]);
  await user.click(button(t("watch.unfold", { path: "Belt" })));
  drag(line("motor"), line("level"));
  await lists(["motor", "level", "Main.beat", "Main.total"]);

  dropText("lamp", table());
  await waitFor(() => expect(inOrder()).toContain("lamp"));
  await waitFor(() =>
    expect(server.askedOf("PUT", "/watch-lists/1").at(-1)).toMatchObject({
      groups: ["Belt"],
      entries: [
        { path: "motor" },
        { path: "level" },
        { path: "Main.beat" },
        { path: "Main.total", group: "Belt" },
        { path: "lamp" },
      ],
    }),
  );
});

test("a column sorts, the other way round, and gives the order of the list back", async () => {
  const { user } = await openList();
  const head = screen.getByRole("columnheader", { name: t("watch.target") });
  await user.click(within(head).getByRole("button"));
  expect(head.getAttribute("aria-sort")).toBe("ascending");
  expect(inOrder()).toEqual(["level", "Main.beat", "Main.total", "motor"]);
  await user.click(within(head).getByRole("button"));
  expect(head.getAttribute("aria-sort")).toBe("descending");
  expect(inOrder()).toEqual(["motor", "Main.total", "Main.beat", "level"]);
  await user.click(within(head).getByRole("button"));
  expect(inOrder()).toEqual(PATHS);
});

test("a filter leaves what is meant: by type, by what changed since", async () => {
  const { server, user } = await openList();
  await waitFor(() => expect(textOf(screen.getByTestId("current:motor"))).toBe("FALSE"));
  await user.click(button(t("watch.filter")));
  await user.type(box(t("watch.filter.text")), "bool");
  await lists(["Main.beat", "motor"]);
  expect(textOf(screen.getByRole("search"))).toContain(t("watch.filter.shown", { shown: 2, total: 4 }));
  await user.clear(box(t("watch.filter.text")));
  await choose(user, t("watch.filter.only", { only: t("watch.only.all") }), t("watch.only.changed"));
  await lists([]);
  server.set("Main.beat", true);
  await lists(["Main.beat"]);
  await user.click(button(t("watch.filter.close")));
  await lists(PATHS);
});

test("a list comes in as CSV; lines that are wrong are named, the others are taken", async () => {
  const { user } = await openList();
  const csv = "path;format;group\nlamp;default;Lamps\nD7;octal;\nD8;hex;\n";
  await user.upload(screen.getByTestId("watch-csv"), new File([csv], "list.csv", { type: "text/csv" }));
  const dialog = await screen.findByRole("dialog", { name: t("watch.csv.bad", { count: 1 }) });
  expect(textOf(dialog)).toContain(t("watch.csv.added", { count: 2 }));
  expect(textOf(dialog)).toContain("octal");
  await user.click(
    within(dialog)
      .getAllByRole("button", { name: t("close") })
      .at(-1) as HTMLElement,
  );
  expect(screen.queryByRole("dialog")).toBeNull();
  await lists([...PATHS, "D8", "lamp"]);
  expect(textOf(group("Lamps"))).toContain("1");
  await waitFor(() => expect(textOf(screen.getByTestId("current:D8"))).toBe("16#0000"));
});

test("a list that somebody deletes stays here, says so, and can be had as one's own", async () => {
  const { server, user } = await openList();
  await waitFor(() =>
    expect(server.askedOf("POST", `/projects/${server.instance.project.id}/watch-lists`)).toHaveLength(1),
  );
  server.say({ type: "watch_list", id: 1, version: 0, author: JO.name });
  const alert = await screen.findByRole("alert");
  expect(textOf(alert)).toContain(t("watch.list.gone", { author: "Jo", name: t("watch.list.new") }));
  expect(inOrder()).toEqual(PATHS);
  await user.click(button(t("watch.list.keep")));
  await waitFor(() => expect(screen.queryByRole("alert")).toBeNull());
  expect(server.askedOf("POST", `/projects/${server.instance.project.id}/watch-lists`)).toHaveLength(2);
});
