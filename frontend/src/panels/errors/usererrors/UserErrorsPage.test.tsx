import { cleanup, render, screen, waitFor, within } from "@testing-library/react";
import { expect, test } from "vitest";
import { loadUserErrors } from "../../../store/errors/userErrors";
import { box, button, textOf } from "../../../testing/find";
import { openPage } from "../../../testing/page";
import { refusal, Status } from "../../../testing/routes";
import { MODEL } from "../../../testing/samples";
import type { FakeServer } from "../../../testing/server";
import { t } from "../../../text";
import type { ModelInfo, UserErrors, UserErrorsDraft } from "../../../wire/types";
import { UserErrorsPage } from "./UserErrorsPage";

const WORK = { program: "write", tool: "write", engine: "write", retain: false, words: 512, description: "" } as const;
const WITH_AREA: ModelInfo = { ...MODEL, areas: [{ ...WORK, name: "W", first: "W0", last: "W511" }] };

/** The errors as a server keeps them: whatever is saved has the next version. */
function store(server: FakeServer) {
  let kept: UserErrors = { errors: [], groups: [], problems: [], readable: true, version: 0 };
  const route = "/projects/*/user-errors";
  server.on("GET", "/instances/*/model", () => WITH_AREA);
  server.on("GET", route, () => kept);
  server.on("POST", `${route}/check`, ({ body }) => {
    const { errors = [] } = body;
    const wrong = errors.flatMap(({ flag }, index) => (flag.startsWith("W999") ? [index] : []));
    const message = "W999 is outside of W: the last word is W511";
    return {
      problems: wrong.map((index) => ({ path: `errors.${index}.flag`, message, code: "", line: 1, column: 1 })),
    };
  });
  server.on("PUT", route, ({ body }) => {
    const draft = body as UserErrorsDraft & { version: number }; // the page sends all of it
    if (draft.version !== kept.version) return new Status(409, conflict());
    kept = { ...kept, ...draft, version: kept.version + 1 };
    return kept;
  });
  const conflict = () => ({
    message: "Somebody saved first",
    theirs: { author: "Ada", path: "errors.xml", text: "", version: kept.version },
  });
  return {
    /** Somebody else saves. */
    savedElsewhere: (change: (errors: UserErrors["errors"]) => UserErrors["errors"]) => {
      kept = { ...kept, errors: change(kept.errors), version: kept.version + 1 };
    },
    get kept() {
      return kept;
    },
  };
}

async function openErrors(prepare: (server: FakeServer) => void = () => undefined) {
  let kept: ReturnType<typeof store> | undefined;
  const page = await openPage((server) => {
    kept = store(server);
    prepare(server);
  });
  render(<UserErrorsPage />);
  await screen.findByText(t("usererrors.empty.title"));
  return { ...page, kept: kept as ReturnType<typeof store> };
}

const list = () => screen.getByRole("listbox", { name: t("usererrors.list") });
const error = (name: string) => within(list()).getByText(name).closest("[role=option]") as HTMLElement;
const field = (key: Parameters<typeof t>[0]) => box(t(key));
const EXAMPLE = t("usererrors.empty.example.name");

test("the first one starts from an example; what is wrong is shown under its field while one types", async () => {
  const { user } = await openErrors();
  await user.click(button(new RegExp(EXAMPLE)));
  expect(textOf(error(EXAMPLE))).toContain("W10.00");
  expect(field("usererrors.id").value).toBe("pump-overheated");

  await user.clear(field("usererrors.flag"));
  await user.type(field("usererrors.flag"), "W999.00");
  await screen.findByText("W999 is outside of W: the last word is W511");
  expect(textOf(error(EXAMPLE))).toContain(t("usererrors.problems.one"));
  expect(field("usererrors.flag").getAttribute("aria-invalid")).toBe("true");
  await user.clear(field("usererrors.flag"));
  await user.type(field("usererrors.flag"), "W10.03");
  await waitFor(() => expect(field("usererrors.flag").getAttribute("aria-invalid")).toBe("false"));
});

test("a second one follows its name, gets details, and is reached by keyboard", async () => {
  const { user, kept } = await openErrors();
  await user.click(button(new RegExp(EXAMPLE)));
  await user.click(button(t("usererrors.add")));
  await user.type(field("usererrors.name"), "Guard open");
  expect(field("usererrors.id").value).toBe("guard-open");
  await user.type(field("usererrors.flag"), "W10.04");
  await user.click(button(t("usererrors.detail.add")));
  await user.type(box(`${t("usererrors.address")} 1`), "W11.00");
  await user.click(screen.getByRole("checkbox", { name: `${t("usererrors.adds")} 1` }));

  list().focus();
  await user.keyboard("{ArrowUp}");
  expect(error(EXAMPLE).getAttribute("aria-selected")).toBe("true");
  expect(field("usererrors.name").value).toBe(EXAMPLE);
  await user.keyboard("{End}");
  expect(field("usererrors.name").value).toBe("Guard open");

  await user.click(button(t("save")));
  await screen.findByText(t("usererrors.about.saved", { version: 1 }));
  expect(kept.kept.errors).toMatchObject([
    { id: "pump-overheated" },
    { id: "guard-open", flag: "W10.04", details: [{ addresses: [{ address: "W11.00", adds: "true" }] }] },
  ]);
  expect(button(t("save"))).toHaveProperty("disabled", true);
});

test("what is not saved is there again after the page was loaded again", async () => {
  const { server, user } = await openErrors();
  await user.click(button(new RegExp(EXAMPLE)));
  cleanup();
  await loadUserErrors(null); // the page has forgotten what it read and what was typed
  render(<UserErrorsPage />);
  await waitFor(() => expect(textOf(error(EXAMPLE))).toContain("W10.00"));
  expect(textOf(screen.getByRole("status"))).toContain(t("unsaved"));
  expect(server.askedOf("PUT", `/projects/${server.instance.project.id}/user-errors`)).toEqual([]);
});

test("a file is imported whole or not at all: refused with its line, the dialog stays", async () => {
  let broken = true;
  const { user, kept } = await openErrors((server) =>
    server.on("POST", "/projects/*/user-errors/import", () => {
      if (broken) return refusal("line 5, column 54: the last word is W511");
      const texts = [
        { language: "en", name: "Pump hot", description: "" },
        { language: "ja", name: "ポンプ過熱", description: "" },
      ];
      const imported = { group: ["Machine"], code: "4F01", flag: "W10.00", severity: "nonfatal", priority: "1000" };
      const rest = { cause: "", memory: "", source: "", verified: "", adds: "", hardware: "", details: [], also: [] };
      return {
        errors: [{ id: "pump-hot", ...imported, ...rest, texts }],
        groups: [],
        problems: [],
        readable: true,
        version: 1,
      };
    }),
  );
  const importing = async () => {
    await user.upload(
      screen.getByLabelText(t("usererrors.import.file")),
      new File(["<x/>"], "a.xml", { type: "text/xml" }),
    );
    await user.click(button(t("usererrors.import.do"), screen.getByRole("dialog")));
  };
  await user.click(button(t("usererrors.import")));
  await importing();
  await waitFor(() =>
    expect(textOf(within(screen.getByRole("dialog")).getByRole("alert"))).toContain("line 5, column 54"),
  );
  expect(kept.kept.errors).toEqual([]);
  broken = false;
  await importing();
  await waitFor(() => expect(screen.queryByRole("dialog")).toBeNull());
  expect(textOf(error("Pump hot"))).toContain("W10.00");
  expect(field("usererrors.name.ja").value).toBe("ポンプ過熱");
});

test("of two who save the second one decides: theirs is taken, or mine is kept", async () => {
  const { user, kept } = await openErrors();
  await user.click(button(new RegExp(EXAMPLE)));
  await user.click(button(t("save")));
  await screen.findByText(t("usererrors.about.saved", { version: 1 }));
  const edit = async (priority: string) => {
    await user.clear(field("usererrors.priority"));
    await user.type(field("usererrors.priority"), priority);
  };
  const rename = (flag: string) => kept.savedElsewhere((errors) => errors.map((each) => ({ ...each, flag })));

  await edit("7");
  rename("W20.00");
  await user.click(button(t("save")));
  await screen.findByText(t("usererrors.conflict", { author: "Ada", version: 2 }));
  expect(field("usererrors.priority").value).toBe("7");
  await user.click(button(t("conflict.theirs")));
  await waitFor(() => expect(field("usererrors.flag").value).toBe("W20.00"));
  expect(field("usererrors.priority").value).toBe("1000");

  await edit("8");
  rename("W30.00");
  await user.click(button(t("save")));
  await screen.findByText(t("usererrors.conflict", { author: "Ada", version: 3 }));
  await user.click(button(t("conflict.mine")));
  await waitFor(() => expect(kept.kept).toMatchObject({ version: 4, errors: [{ priority: "8", flag: "W20.00" }] }));
});
