import { render, screen, waitFor } from "@testing-library/react";
import { beforeEach, expect, test } from "vitest";
import { openTour, useTour } from "../../store/page/tour";
import { usePlc } from "../../store/plc/plc";
import { useDocuments } from "../../store/project/documents";
import { button, textOf } from "../../testing/find";
import { openPage } from "../../testing/page";
import { symbol } from "../../testing/samples";
import { t } from "../../text";
import { STEPS } from "./steps";
import Tour from "./Tour";

beforeEach(() => useTour.setState({ open: false, at: 0 }));

const card = () => textOf(screen.getByRole("region", { name: t("tour.title") }));
const at = (name: string) => STEPS.findIndex((step) => step.name === name);

async function openAt(name: (typeof STEPS)[number]["name"]) {
  const page = await openPage((server) => server.has(symbol("start", "BOOL"), false));
  useTour.setState({ open: true, at: at(name) });
  const { unmount } = render(<Tour />);
  return { ...page, unmount };
}

test("a step shows its panel, waits for the event whoever causes it, says what happened, and then leads on", async () => {
  const { server, places, user } = await openAt("write");
  expect(card()).toContain(t("tour.write"));
  expect(places).toEqual(["panel watch"]);
  expect(button(t("tour.skip"))).toBeDefined();
  server.set("start", true);
  await waitFor(() => expect(card()).toContain(t("tour.write.done")));
  await user.click(button(t("tour.next")));
  expect(card()).toContain(t("tour.raise"));
  usePlc.setState({ errors: new Map([["basic-io-error", { status: "generated" } as never]]) });
  await waitFor(() => expect(card()).toContain(t("tour.raise.done")));
});

test("a step can be skipped and gone back to, and the tour goes on later where it was left", async () => {
  const { user, unmount } = await openAt("into");
  await user.click(button(t("tour.skip")));
  expect(card()).toContain(t("tour.back"));
  await user.click(button(t("tour.before")));
  expect(card()).toContain(t("tour.into"));
  await user.click(button(t("tour.leave")));
  expect(useTour.getState()).toEqual({ open: false, at: at("into") });
  expect(JSON.parse(localStorage.getItem("scanbench.tour") ?? "")).toEqual({ open: false, at: at("into") });
  unmount();
  openTour();
  render(<Tour />);
  expect(card()).toContain(t("tour.into"));
});

test("it points at the control, and lets clicks through to it", async () => {
  await openAt("recover");
  const pane = document.createElement("div");
  pane.dataset.pane = "errors";
  pane.innerHTML = `<div class="acts"><button class="btn primary">x</button><button class="btn sm">y</button></div>`;
  document.body.append(pane);
  const control = pane.querySelector(".sm") as HTMLElement;
  control.getBoundingClientRect = () => new DOMRect(100, 200, 60, 24);
  await waitFor(() => {
    const ring = document.querySelector<HTMLElement>(".tourring");
    expect(ring?.style.left).toBe("96px");
    expect(ring?.style.top).toBe("196px");
  });
  pane.remove();
  await waitFor(() => expect(document.querySelector(".tourring")).toBeNull());
});

test("after the last step it can begin again", async () => {
  const { user } = await openAt("go");
  // Nothing is halted, so there is nothing to do.
  await user.click(await screen.findByRole("button", { name: t("tour.next") }));
  expect(card()).toContain(t("tour.end"));
  await user.click(button(t("tour.close")));
  expect(useTour.getState()).toEqual({ open: false, at: 0 });
});

test("a different project is not called the sample", async () => {
  await openAt("sample");
  const sample = ["Main.st", "Belt.st"].map((path) => ({ path, version: 1, saved: "", author: "Ann" }));
  useDocuments.setState({ files: sample });
  await waitFor(() => expect(card()).toContain(t("tour.sample.done")));
  useDocuments.setState({ files: sample.slice(1) });
  await waitFor(() => expect(card()).toContain(t("tour.sample")));
  expect(card()).not.toContain(t("tour.sample.done"));
});
