import { act, render, screen, waitFor } from "@testing-library/react";
import type { IDockviewPanelProps } from "dockview-react";
import { expect, test } from "vitest";
import { openFile, openPage as show, useNavigation } from "../store/page/navigate";
import { chooseProject } from "../store/plc/bench";
import { useDocuments } from "../store/project/documents";
import { box } from "../testing/find";
import { openPage } from "../testing/page";
import { MODEL } from "../testing/samples";
import type { FakeServer } from "../testing/server";
import { t } from "../text";
import type { HaltInfo, Pou } from "../wire/types";
import { Dock } from "./Dock";
import { components } from "./dockParts";

const MAIN: Pou = { name: "Main", kind: "program", file: "Main.st", line: 1 };

const HALT: HaltInfo = {
  by: "Mika",
  column: 1,
  count: 1,
  end_column: 3,
  end_line: 2,
  file: "Main.st",
  instance: "Main",
  line: 2,
  number: 1,
  past: false,
  pou: "Main",
  reason: "step",
  task: "",
  text: "",
};

const page = () => screen.queryByText(t("usererrors.empty.title"));
const tabOf = (file: string) => waitFor(() => screen.getByTestId(`close:${file}`));

test("a page stays the one that is shown when the first file opens by itself, and when the browser comes back to it", async () => {
  await openPage((server) => {
    server.on("GET", "/projects/*/user-errors", () => ({
      errors: [],
      groups: [],
      version: 0,
      readable: true,
      problems: [],
    }));
  });
  const { unmount } = render(<Dock ref={null} />);
  show("usererrors");
  await waitFor(() => expect(page()).not.toBeNull());
  // The compiler's answer comes later, and with it the first program.
  useDocuments.setState({ pous: [MAIN] });
  await tabOf("Main.st");
  expect(page()).not.toBeNull();
  unmount();
  render(<Dock ref={null} />);
  await tabOf("Main.st");
  expect(page()).not.toBeNull();
});

test("a different project shows its program, and not the page that was open", async () => {
  const { server } = await openPage((server) => {
    const none = { errors: [], groups: [], version: 0, readable: true, problems: [] };
    server.on("GET", "/projects/*/user-errors", () => none);
    server.on("GET", "/models/*", () => MODEL);
    server.on("POST", "/projects/*/check", () => ({ checks: [], tasks: [], pous: [MAIN], problems: [] }));
  });
  render(<Dock ref={null} />);
  await tabOf("Main.st");
  act(() => show("usererrors"));
  await waitFor(() => expect(page()).not.toBeNull());
  await chooseProject({ ...server.instance.project, id: 4711 });
  await waitFor(() => expect(page()).toBeNull());
});

/** A project with two files, of which the program is open, and the caret is in its text. */
async function type(prepare: (server: FakeServer) => void = () => undefined) {
  const page = await openPage((server) => {
    const info = (path: string) => ({ path, version: 1, author: "Mika" });
    server.on("GET", "/projects/*/files", () => [info("Main.st"), info("Valve.st")]);
    server.on("GET", "/projects/*/files/**", (_question, [, , path = ""]) => ({ ...info(path), text: "one\ntwo" }));
    prepare(server);
  });
  render(<Dock ref={null} />);
  act(() => openFile("Main.st"));
  await waitFor(() => box("Main.st"));
  act(() => box("Main.st").focus());
  return page;
}

test("who types goes on typing when the PLC halts in the text, in front already", async () => {
  const { server, user } = await type();
  act(() => server.becomes({ state: "halted", halt: { ...HALT, file: "Main.st" } }));
  await user.keyboard("x");
  expect(box("Main.st").value).toContain("x");
});

test("who types goes on in the file in which a step ends", async () => {
  const { server } = await type();
  act(() => server.becomes({ state: "halted", halt: { ...HALT, file: "Valve.st" } }));
  await waitFor(() => box("Valve.st"));
  expect(useNavigation.getState().place).toMatchObject({ path: "Valve.st", line: 2 });
});

test("a panel is loaded when it is first shown, and stays loaded", () => {
  let tell: () => void = () => undefined;
  const api = {
    id: "trace",
    isVisible: false,
    onDidVisibilityChange: (told: () => void) => {
      tell = told;
      return { dispose: () => undefined };
    },
  };
  const Trace = components.trace;
  if (!Trace) throw new Error("no such panel");
  const props = { api } as unknown as IDockviewPanelProps;
  const { container } = render(<Trace {...props} />);
  const loaded = () => container.querySelector("[data-pane=trace]") !== null;
  const becomes = (isVisible: boolean) => {
    api.isVisible = isVisible;
    act(tell);
  };
  expect(loaded()).toBe(false);
  becomes(true);
  expect(loaded()).toBe(true);
  becomes(false);
  expect(loaded()).toBe(true);
});
