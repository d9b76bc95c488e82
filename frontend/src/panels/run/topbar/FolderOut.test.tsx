import { fireEvent, render, screen } from "@testing-library/react";
import { zipSync } from "fflate";
import { afterEach, expect, test, vi } from "vitest";
import { folderHandle } from "../../../testing/folderHandle";
import { rest } from "../../../wire/rest";
import type { Project } from "../../../wire/types";
import { FolderOut } from "./FolderOut";

HTMLDialogElement.prototype.showModal = vi.fn();
afterEach(() => vi.restoreAllMocks());

test("the dialog says what is new and what is replaced, writes it, and says how many files", async () => {
  const bytes = (text: string) => new TextEncoder().encode(text);
  const packed = zipSync({ "Main.st": bytes("new"), POUs: { "Belt.st": bytes("belt") }, "project.json": bytes("{}") });
  vi.spyOn(rest, "packProject").mockResolvedValue(new Blob([new Uint8Array(packed)]));
  const texts = new Map([
    ["Main.st", "old"],
    ["project.json", "{}"],
  ]);
  const onClose = vi.fn();
  render(<FolderOut project={{ id: 1 } as Project} folder={folderHandle(texts)} onClose={onClose} />);

  expect((await screen.findByRole("list", { name: /Replaced/ })).textContent).toBe("Main.st");
  expect(screen.getByRole("list", { name: /New/ }).textContent).toBe("POUs/Belt.st");
  fireEvent.click(screen.getByRole("button", { name: "Write 2 files" }));
  expect((await screen.findByRole("status")).textContent).toBe("Files written: 2");
  expect(texts.get("Main.st")).toBe("new");
  expect(texts.get("POUs/Belt.st")).toBe("belt");
  expect(onClose).not.toHaveBeenCalled();
});
