import { fireEvent, render, screen } from "@testing-library/react";
import { afterEach, expect, test, vi } from "vitest";
import * as download from "../../../store/page/download";
import { rest } from "../../../wire/rest";
import type { Project } from "../../../wire/types";
import { XmlOut } from "./XmlOut";

HTMLDialogElement.prototype.showModal = vi.fn();
afterEach(() => vi.restoreAllMocks());

test("the dialog says what a form has no place for, before the file is saved", async () => {
  vi.spyOn(rest, "writeProject").mockImplementation(async (_, form) => ({
    name: "Line.xml",
    text: `<${form}/>`,
    left_out: form === "tc6" ? [] : ["Main: a chart"],
  }));
  const save = vi.spyOn(download, "saveFile").mockReturnValue();
  const onClose = vi.fn();
  render(<XmlOut project={{ id: 1, name: "Line" } as Project} onClose={onClose} />);

  expect(await screen.findByText("All of the program is in the file.")).toBeTruthy();
  fireEvent.click(screen.getByRole("radio", { name: "IEC 61131-10" }));
  expect((await screen.findByRole("list", { name: /Left out/ })).textContent).toBe("Main: a chart");
  fireEvent.click(screen.getByRole("button", { name: "Save the file" }));
  await vi.waitFor(() => expect(onClose).toHaveBeenCalled());
  expect(save).toHaveBeenCalledWith(expect.any(Blob), "Line.xml");
});

test("a refusal is said, and nothing can be saved", async () => {
  vi.spyOn(rest, "writeProject").mockRejectedValue(new Error("the project is gone"));
  render(<XmlOut project={{ id: 1, name: "Line" } as Project} onClose={vi.fn()} />);

  expect(await screen.findByText("the project is gone")).toBeTruthy();
  expect(screen.getByRole<HTMLButtonElement>("button", { name: "Save the file" }).disabled).toBe(true);
});
