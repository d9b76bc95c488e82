import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { helpHere } from "../../app/helpHere";
import { showHelp, useHelp } from "../../store/page/help";
import { chooseLanguage } from "../../store/page/prefs";
import { useDocuments } from "../../store/project/documents";
import { button } from "../../testing/find";
import { openPage } from "../../testing/page";
import { t } from "../../text";
import { HelpPanel } from "./HelpPanel";

const shows = (title: string) => screen.findByRole("article", { name: title });
const marked = () => document.querySelector(".here")?.textContent;

const TEXT = "beat : TON; motor := 1;";

async function openHelp() {
  const page = await openPage();
  useHelp.setState({ trail: [["README.md"]], at: 0, search: "" });
  render(<HelpPanel />);
  await screen.findByRole("searchbox");
  return page;
}

test("links lead from page to page, and back and forward again", async () => {
  const { user } = await openHelp();
  const contents = await screen.findByRole("article");
  await user.click(within(contents).getByRole("link", { name: "the watch table" }));
  await shows("The watch table and the forces");
  await user.click(screen.getAllByRole("link", { name: "in-outs" })[0] as HTMLElement);
  await shows("Changing an in-out from outside");
  await user.click(button(t("help.back")));
  await shows("The watch table and the forces");
  await user.click(button(t("help.forward")));
  await shows("Changing an in-out from outside");
});

test("a search finds a standard block, and its row is marked", async () => {
  const { user } = await openHelp();
  await user.type(screen.getByRole("searchbox"), "ton");
  await user.click(
    within(screen.getByRole("list", { name: t("help.found") })).getAllByRole("button")[0] as HTMLElement,
  );
  await shows("The standard library");
  expect(marked()).toContain("On-delay timer");
  await user.type(screen.getByRole("searchbox"), "nothingsaysthis");
  expect(screen.getByText(t("help.nothing", { text: "nothingsaysthis" }))).toBeDefined();
});

test("F1 explains the block or the problem at the caret, and else the panel", async () => {
  const { places } = await openHelp();
  const pane = document.createElement("div");
  pane.dataset.pane = "editor";
  pane.innerHTML = "<input>";
  document.body.append(pane);
  pane.querySelector("input")?.focus();
  const at = (column: number) =>
    useDocuments.setState({
      active: "Main.st",
      cursor: { line: 1, column },
      open: { "Main.st": { path: "Main.st", text: TEXT, savedText: TEXT } } as never,
      problems: [],
    });
  at(9);
  helpHere();
  expect(places).toEqual(["page help"]);
  await waitFor(() => expect(marked()).toContain("On-delay timer"));
  at(14);
  helpHere();
  await shows("The window");
  expect(marked()).toBe("Editor");
  useDocuments.setState({ problems: [{ file: "Main.st", line: 1, column: 1, code: "D001" } as never] });
  helpHere();
  await shows("D001: name declared twice");
  pane.dataset.pane = "forces";
  helpHere();
  await shows("The watch table and the forces");
  expect(marked()).toBe("Forces");
  pane.remove();
  useDocuments.setState({ active: null, cursor: null, open: {}, problems: [] });
});

test("in Japanese the help says that it is in English", async () => {
  await openHelp();
  chooseLanguage("ja");
  showHelp("watch.md");
  expect(await screen.findByRole("note")).toBeDefined();
  expect((await shows("The watch table and the forces")).lang).toBe("en");
  chooseLanguage("en");
});
