import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { addToTrace } from "../../../store/trace/added";
import { openPage } from "../../../testing/page";
import { refusal } from "../../../testing/routes";
import { MIKA, TRACE } from "../../../testing/samples";
import { t } from "../../../text";
import { StatusBar } from "./StatusBar";

const PATH = "Main.st";

test("the status bar says when a file was saved, and by whom if it was somebody else", async () => {
  const today = new Date();
  today.setHours(14, 30);
  const file = { path: PATH, version: 1, author: "Jo", saved: "2026-01-05T09:00:00" };
  const { server } = await openPage((server) => {
    server.on("GET", "/projects/*/files", () => [file]);
    server.on("GET", "/projects/*/files/**", () => ({ ...file, text: "one" }));
  });
  render(<StatusBar />);
  await openDocument(PATH);
  useDocuments.setState({ active: PATH });
  const says = (text: string) => waitFor(() => expect(screen.getByText(text)).toBeTruthy());
  await says(t("status.savedby", { at: "2026-01-05 09:00", author: "Jo" }));
  const newer = { ...file, version: 2, saved: today.toISOString() };
  server.on("GET", "/projects/*/files/**", () => ({ ...newer, text: "two" }));
  server.say({ type: "saved", author: "Jo", file: newer });
  await says(t("status.savedby", { at: "14:30", author: "Jo" }));
  const own = { ...newer, version: 3, author: MIKA.name };
  server.on("GET", "/projects/*/files/**", () => ({ ...own, text: "three" }));
  server.say({ type: "saved", author: own.author, file: own });
  await says(t("status.saved", { at: "14:30" }));
});

test("a signal that is added to the trace is said here, and what is in front stays until somebody wants to see it", async () => {
  const { server, places, user } = await openPage((server) => {
    server.on("POST", "/instances/*/traces", ({ body }) =>
      body.signals[0] === "Main.none" ? refusal("Main.none is not known") : TRACE,
    );
  });
  render(<StatusBar />);
  await addToTrace("Main.none");
  expect(places).toEqual(["panel trace"]);
  await addToTrace("Main.n");
  expect(server.askedOf("POST", `/instances/${server.instance.id}/traces`)).toHaveLength(2);
  expect(places).toHaveLength(1);
  await user.click(await screen.findByRole("button", { name: t("trace.added", { path: "Main.n" }) }));
  expect(places).toEqual(["panel trace", "panel trace"]);
});
