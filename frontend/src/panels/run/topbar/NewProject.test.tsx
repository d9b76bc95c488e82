import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { begins, box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { MODEL, someInstance, someProject } from "../../../testing/samples";
import { t } from "../../../text";
import type { ModelSummary } from "../../../wire/types";
import { NewProject } from "./NewProject";

const MODELS: ModelSummary[] = [{ name: "CJ1M", vendor: "Omron", description: "", error_count: 3, verified_count: 3 }];

test("a project needs its model: it is not made before the models are here, and they are asked for again", async () => {
  let arrive: (models: ModelSummary[]) => void = () => undefined;
  let tries = 0;
  const { server, user } = await openPage((server) => {
    server.on("GET", "/models", () => {
      tries += 1;
      if (tries === 1) throw new TypeError("the connection was refused");
      return new Promise((resolve) => {
        arrive = resolve;
      });
    });
    server.on("GET", "/models/*", () => MODEL);
    server.on("POST", "/projects", () => someProject(800));
    server.on("PUT", "/projects/*/files/**", () => ({ path: "Main.st", version: 1, author: "Mika" }));
    const result = { ok: true, needs_agreement: false, message: "", changes: [], pous: [], problems: [] };
    server.on("POST", "/projects/*/build", () => ({ ...result, project: someProject(800) }));
    server.on("POST", "/instances", () => {
      server.instance = someInstance(800, someProject(800));
      return server.instance;
    });
  });
  let closed = false;
  render(<NewProject onClose={() => (closed = true)} />);
  const dialog = screen.getByRole("dialog", { name: t("newproject.title") });
  await waitFor(() => expect(textOf(within(dialog).queryByRole("alert"))).toContain(t("lost.read")));
  await user.type(box(begins(t("newproject.name")), dialog), "late");
  await user.click(button(t("lost.now"), dialog));
  await waitFor(() => expect(textOf(within(dialog).getByRole("combobox"))).toContain(t("newproject.loading")));
  expect(button(t("create"), dialog)).toHaveProperty("disabled", true);
  await user.type(box(begins(t("newproject.name")), dialog), "{Enter}");
  expect(server.askedOf("POST", "/projects")).toEqual([]);

  arrive(MODELS);
  await waitFor(() => expect(button(t("create"), dialog)).toHaveProperty("disabled", false));
  await user.click(button(t("create"), dialog));
  await waitFor(() => expect(closed).toBe(true));
  expect(server.askedOf("POST", "/projects")).toEqual([{ name: "late", model: "CJ1M" }]);
  expect(server.askedOf("POST", "/instances")).toMatchObject([{ project: 800 }]);
});
