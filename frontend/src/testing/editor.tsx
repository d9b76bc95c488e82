/**
 * Runs before the tests of panels: a plain field in the place of Monaco, which jsdom cannot show; what is typed goes the same way. It is so
 * in all tests, as they share the modules: what one of them replaced for itself would be replaced or not by the order of the files.
 */
import { vi } from "vitest";
import { edit, useDocuments } from "../store/project/documents";

vi.mock("../panels/project/editor/CodeView", () => ({
  default: ({ path, past }: { path: string; past: string | null }) => {
    const text = useDocuments(({ open }) => open[path]?.text ?? "");
    return (
      <textarea
        aria-label={path}
        value={past ?? text}
        readOnly={past !== null}
        onChange={({ target }) => edit(path, target.value)}
      />
    );
  },
}));
vi.mock("../panels/project/editor/DiffView", () => ({
  default: ({ theirs }: { theirs: string }) => <pre>{theirs}</pre>,
}));
vi.mock("../panels/project/editor/TextsDiff", () => ({
  default: ({ before, after }: { before: string; after: string }) => <pre>{`${before} -> ${after}`}</pre>,
}));
