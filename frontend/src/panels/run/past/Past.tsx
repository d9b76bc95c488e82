import { ChangesDialog } from "./ChangesDialog";
import { RerunDialog } from "./RerunDialog";
import { WriterDialog } from "./WriterDialog";
import "./past.css";

/** The dialogs about the past, which several panels open. */
export function Past() {
  return (
    <>
      <ChangesDialog />
      <WriterDialog />
      <RerunDialog />
    </>
  );
}
