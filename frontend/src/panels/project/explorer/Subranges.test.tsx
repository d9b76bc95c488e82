import { render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import type { Policies } from "../../../store/project/subranges";
import { openPage } from "../../../testing/page";
import { Status } from "../../../testing/routes";
import { t } from "../../../text";
import { DialectChoice } from "./DialectChoice";

async function openPolicies(refuses = "") {
  let saved: Policies = { "*": "report", "Main.speed": "trap" };
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/dialect", () => ({ dialect: "iec" as const }));
    server.on("GET", "/projects/*/subranges", () => ({ policies: saved }));
    server.on("PUT", "/projects/*/subranges", ({ body }) => {
      if (refuses) return new Status(422, { message: refuses, near: [] });
      saved = body.policies;
      return { policies: saved };
    });
  });
  const project = page.server.instance.project.id;
  render(<DialectChoice project={project} />);
  await page.user.click(await screen.findByRole("button", { name: t("subranges.open") }));
  await screen.findByText("Main.speed");
  const last = () => page.server.askedOf("PUT", `/projects/${project}/subranges`).at(-1);
  return { ...page, last };
}

test("the policy of the whole project is shown, and what is chosen is saved", async () => {
  const { user, last } = await openPolicies();
  const all = screen.getByLabelText(t("subranges.all")) as HTMLSelectElement;
  expect(all.value).toBe("report");
  await user.selectOptions(all, t("subranges.hold"));
  await waitFor(() => expect(last()).toEqual({ policies: { "*": "hold", "Main.speed": "trap" } }));
});

test("an entry is added and removed", async () => {
  const { user, last } = await openPolicies();
  await user.type(screen.getByLabelText(t("subranges.name")), "Tank.fill");
  await user.selectOptions(screen.getByLabelText(t("subranges.new")), t("subranges.off"));
  await user.click(screen.getByRole("button", { name: t("subranges.add") }));
  expect(await screen.findByText("Tank.fill")).toBeTruthy();
  expect(last()).toEqual({ policies: { "*": "report", "Main.speed": "trap", "Tank.fill": "off" } });
  await user.click(screen.getByRole("button", { name: t("subranges.remove", { name: "Main.speed" }) }));
  await waitFor(() => expect(last()).toEqual({ policies: { "*": "report", "Tank.fill": "off" } }));
  expect(screen.queryByText("Main.speed")).toBeNull();
});

test("a name that is refused stays as it was typed, with the reason", async () => {
  const { user } = await openPolicies("no name of a variable");
  const field = screen.getByLabelText(t("subranges.name")) as HTMLInputElement;
  await user.type(field, "a b{Enter}");
  expect(await within(screen.getByRole("dialog")).findByText(/no name of a variable/)).toBeTruthy();
  expect(field.value).toBe("a b");
});
