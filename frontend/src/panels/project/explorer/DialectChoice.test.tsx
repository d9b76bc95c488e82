import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { LANGUAGE_FILE } from "../../../store/project/dialect";
import { useDocuments } from "../../../store/project/documents";
import { openPage } from "../../../testing/page";
import { Status } from "../../../testing/routes";
import { t } from "../../../text";
import type { ProjectDialect } from "../../../wire/types";
import { DialectChoice } from "./DialectChoice";

async function openChoice(refuses = "") {
  const saved: ProjectDialect = { dialect: "iec" };
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/dialect", () => ({ ...saved }));
    server.on("PUT", "/projects/*/dialect", ({ body }) => {
      if (refuses) return new Status(403, { message: refuses, near: [] });
      saved.dialect = body.dialect;
      return { ...saved };
    });
  });
  render(<DialectChoice project={page.server.instance.project.id} />);
  const choice = (await screen.findByLabelText(t("dialect"))) as HTMLSelectElement;
  return { ...page, choice, saved };
}

test("the dialect is shown, and what is chosen is saved", async () => {
  const { user, choice, server } = await openChoice();
  expect(choice.value).toBe("iec");
  await user.selectOptions(choice, t("dialect.twincat"));
  await waitFor(() =>
    expect(server.askedOf("PUT", `/projects/${server.instance.project.id}/dialect`)).toEqual([{ dialect: "twincat" }]),
  );
  expect(choice.value).toBe("twincat");
});

test("a dialect that somebody else saved is shown", async () => {
  const { choice, saved } = await openChoice();
  saved.dialect = "codesys";
  useDocuments.setState({ files: [{ path: LANGUAGE_FILE, version: 7, author: "Mika" }] });
  await waitFor(() => expect(choice.value).toBe("codesys"));
});

test("a change that is refused is taken back, and the reason is told", async () => {
  const { user, choice } = await openChoice("you may only look");
  await user.selectOptions(choice, t("dialect.codesys"));
  expect((await screen.findByRole("alert")).textContent).toContain("you may only look");
  expect(choice.value).toBe("iec");
});

test("a library that the programs use is added as a file, and then shown", async () => {
  const library = {
    name: "Util",
    about: "Util of CODESYS: bits.",
    source: "https://x",
    declared: 8,
    stubs: 0,
    path: "libraries/Util.st",
  };
  let added = false;
  const page = await openPage((server) => {
    server.on("GET", "/projects/*/dialect", () => ({ dialect: "codesys" as const }));
    server.on("GET", "/projects/*/libraries", () => [{ ...library, added, used: !added }]);
    server.on("POST", "/projects/*/libraries/*", () => {
      added = true;
      return { path: library.path, version: 1, author: "Mika" };
    });
  });
  const project = page.server.instance.project.id;
  render(<DialectChoice project={project} />);
  await page.user.click(await screen.findByRole("button", { name: t("libraries.open") }));
  expect(await screen.findByText(t("libraries.used"))).toBeTruthy();
  expect(screen.getByRole("link", { name: t("libraries.report") }).getAttribute("href")).toBe(
    `/api/projects/${project}/report`,
  );
  await page.user.click(screen.getByRole("button", { name: t("libraries.add.of", { name: "Util" }) }));
  expect(await screen.findByRole("button", { name: t("libraries.show.of", { name: "Util" }) })).toBeTruthy();
  expect(page.server.askedOf("POST", `/projects/${project}/libraries/Util`)).toHaveLength(1);
  expect(screen.queryByText(t("libraries.used"))).toBeNull();
});
