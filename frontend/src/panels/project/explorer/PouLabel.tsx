import type { FileNode, PouNode } from "../../../logic/project/explorer";

/** The name of a declaration; with its file when the file contains several. */
export function PouLabel({ node }: { node: PouNode | FileNode }) {
  return (
    <>
      {node.name}
      {node.kind === "pou" && node.shared && <span className="faint"> {node.file}</span>}
    </>
  );
}
