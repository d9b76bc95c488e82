import { render, screen, waitFor } from "@testing-library/react";
import { expect, test } from "vitest";
import { openPage as show } from "../store/page/navigate";
import { useDocuments } from "../store/project/documents";
import { openPage } from "../testing/page";
import { t } from "../text";
import type { Pou } from "../wire/types";
import { Dock } from "./Dock";

const MAIN: Pou = { name: "Main", kind: "program", file: "Main.st", line: 1 };

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
