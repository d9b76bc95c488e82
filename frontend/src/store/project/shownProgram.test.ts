import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { eventually } from "../../testing/eventually";
import { rest } from "../../wire/rest";
import type { Instance, InstanceState, ProgramText, Project } from "../../wire/types";
import { useBench } from "../plc/bench";
import { type LinkStatus, resetPlc, usePlc } from "../plc/plc";
import { type Document, useDocuments } from "./documents";
import { ranApart, shownText, showsRan, useShownProgram } from "./shownProgram";

const connected: LinkStatus = { state: "open", lostAt: null, attempt: 0, nextTryAt: null };
const live = { state: "paused", program_version: 2, past: null, pid: 1 } as InstanceState;
const past = (version: number) =>
  ({ ...live, state: "past", program_version: version, past: { live_scan: 9, by: "Ann" } }) as InstanceState;
const ran = (version: number, text: string): ProgramText => ({ version, files: { "Main.st": text }, pous: [] });

let instance = 0;

beforeEach(() => {
  instance += 1; // the program of an instance is fetched once
  usePlc.setState({ link: connected, state: live });
  useBench.setState({ instance: { id: instance } as Instance, project: { id: 1, version: 2 } as Project });
});
afterEach(() => {
  vi.restoreAllMocks();
  resetPlc();
  useDocuments.setState({ open: {} });
  useBench.setState({ instance: null, project: null });
});

const shown = () => useShownProgram.getState();

it("requests the program that ran again once the state of the PLC changes", async () => {
  const asked = vi.spyOn(rest, "programText").mockRejectedValueOnce(new Error("the PLC does not answer"));
  usePlc.setState({ state: { ...past(1), state: "silent" } });
  await eventually(() => expect(shown().refused).toBe("the PLC does not answer"));
  asked.mockResolvedValue(ran(1, "old"));
  usePlc.setState({ state: past(1) });
  expect(shown().refused).toBeNull();
  await eventually(() => expect(shown().program?.files).toEqual({ "Main.st": "old" }));
});

it("requests it again once there is a connection", async () => {
  const asked = vi.spyOn(rest, "programText").mockRejectedValueOnce(new Error("no connection"));
  usePlc.setState({ state: past(1) });
  usePlc.setState({ link: { ...connected, state: "lost" } });
  await eventually(() => expect(shown().refused).toBe("no connection"));
  asked.mockResolvedValue(ran(1, "old"));
  usePlc.setState({ link: connected });
  await eventually(() => expect(shown().program?.version).toBe(1));
});

it("requests it again when the refusal comes after the connection", async () => {
  let refuse: (error: Error) => void = () => {};
  const asked = vi.spyOn(rest, "programText").mockReturnValueOnce(
    new Promise((_, reject) => {
      refuse = reject;
    }),
  );
  usePlc.setState({ state: past(1) });
  usePlc.setState({ link: { ...connected, state: "lost" } });
  usePlc.setState({ link: connected });
  asked.mockResolvedValue(ran(1, "old"));
  refuse(new Error("no connection"));
  await eventually(() => expect(shown().program?.version).toBe(1));
});

const open = (text: string, savedText = text) =>
  useDocuments.setState({ open: { "Main.st": { path: "Main.st", text, savedText } as Document } });

it("shows the text that ran if the text was saved but not built since", async () => {
  vi.spyOn(rest, "programText").mockResolvedValue(ran(2, "built"));
  open("saved");
  expect(showsRan("Main.st")).toBe(false);
  usePlc.setState({ state: past(2) });
  await eventually(() => expect(showsRan("Main.st")).toBe(true));
  expect(shownText("Main.st")).toMatchObject({ text: "built", built: "built" });
  usePlc.setState({ state: live });
  expect(shownText("Main.st").text).toBe("saved");
});

it("continues with the edited text in the past if the saved text is the one that ran, or that is not known", async () => {
  const asked = vi.spyOn(rest, "programText").mockRejectedValueOnce(new Error("the PLC does not answer"));
  open("edited", "built");
  usePlc.setState({ state: past(2) });
  await eventually(() => expect(shown().refused).not.toBeNull());
  expect(shownText("Main.st")).toMatchObject({ text: "edited", built: "built" });
  asked.mockResolvedValue(ran(2, "built"));
  usePlc.setState({ state: { ...past(2), state: "halted" } });
  await eventually(() => expect(shown().program).not.toBeNull());
  expect(shownText("Main.st")).toMatchObject({ text: "edited", built: "built" });
});

it("shows the text of an older version at once, and also when the project is built meanwhile", async () => {
  vi.spyOn(rest, "programText").mockResolvedValue(ran(2, "built"));
  open("built");
  usePlc.setState({ state: past(2) });
  await eventually(() => expect(shown().program).not.toBeNull());
  expect(showsRan("Main.st")).toBe(false);
  useBench.setState({ project: { id: 1, version: 3 } as Project });
  expect(showsRan("Main.st")).toBe(true);
});

it("says which version ran if the project is no longer that version: built since, or saved", async () => {
  vi.spyOn(rest, "programText").mockImplementation(async (_, version) => ran(version, "old"));
  expect(ranApart()).toBeNull();
  usePlc.setState({ state: past(1) });
  expect(ranApart()).toBe(1);
  usePlc.setState({ state: past(2) });
  await eventually(() => expect(shown().program?.version).toBe(2));
  expect(ranApart()).toBeNull();
  const saved = (savedText: string) => ({ text: savedText, savedText }) as Document;
  useDocuments.setState({ open: { "Main.st": saved("old"), "Tank.st": saved("") } });
  usePlc.setState({ state: { ...past(2), scan: 4 } });
  expect(ranApart()).toBe(2); // Tank.st is new
  useDocuments.setState({ open: { "Main.st": saved("old") } });
  expect(ranApart()).toBeNull();
  usePlc.setState({ state: live });
  useDocuments.setState({ open: { "Main.st": saved("new") } });
  expect(ranApart()).toBeNull();
});

it("asks nothing of another PLC because of the past of the one before", async () => {
  const asked = vi.spyOn(rest, "programText").mockResolvedValue(ran(1, "old"));
  usePlc.setState({ state: past(1) });
  await eventually(() => expect(shown().program?.version).toBe(1));
  useBench.setState({ instance: { id: instance + 1000 } as Instance });
  expect(asked).toHaveBeenCalledTimes(1);
  expect(shown().version).toBeNull();
});
