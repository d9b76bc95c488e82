import { useState } from "react";
import { useShallow } from "zustand/react/shallow";
import { inNames } from "../../../logic/errors/catalogue";
import { type Entry, kindred, needsDetails, takenOver, troubles } from "../../../logic/errors/details";
import { useCatalogue } from "../../../store/errors/catalogue";
import { useShape } from "../../../store/errors/shape";
import {
  closeDialog,
  entriesOf,
  instancesOf,
  raise,
  setEntries,
  useSimulator,
  wantedNow,
} from "../../../store/errors/simulator";
import { useForbidden, usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import { Icon } from "../../../ui/Icon";
import type { ErrorInfo } from "../../../wire/types";
import { DetailsPage } from "./DetailsPage";
import "./dialog.css";
import { Gap, type GapForm, gapOf } from "./Gap";
import { PageList, type PageState } from "./PageList";
import { Preview } from "./Preview";
import { ShapeFields } from "./ShapeFields";
import { WayOn } from "./WayOn";

/** Details of several errors, a page for each that needs some; then all are raised in one seam, or one by one. */
export function DetailsDialog({ errors }: { errors: readonly ErrorInfo[] }) {
  const state = useSimulator(
    useShallow(({ details, checked, selected, filter, status, severity, reaction }) => ({
      ...{ details, checked, selected },
      ...{ filter, status, severity, reaction },
    })),
  );
  const shape = useShape();
  const history = usePlc((plc) => plc.errors);
  const forbidden = useForbidden("errors");
  const needing = errors.filter(needsDetails);
  // Opened on request although no detail is required: every error has its page.
  const pages = needing.length > 0 ? needing : errors;
  const [page, setPage] = useState(0);
  const [seen, setSeen] = useState<ReadonlySet<string>>(new Set());
  const [same, setSame] = useState<ReadonlySet<string>>(new Set());
  const [gap, setGap] = useState<GapForm>({ sequence: false, text: "1", unit: "scans" });
  const error = pages[Math.min(page, pages.length - 1)];
  if (!error) return null;

  const entriesNow = (of: ErrorInfo) => entriesOf(state, of, history.get(of.id));
  const bad = (of: ErrorInfo) => troubles(of, entriesNow(of)).size > 0;
  const scans = gapOf(gap);
  const ready = forbidden === null && !errors.some(bad) && shape.ready && scans !== null;
  const { plain } = shape;
  // Ticked instances have their details, and are raised together with the others.
  const single = instancesOf(state);
  const count = errors.length + single.length;

  function goTo(next: number): void {
    if (error) setSeen(new Set([...seen, error.id]));
    setPage(Math.max(0, Math.min(pages.length - 1, next)));
  }

  function change(name: string, entry: Entry): void {
    if (!error) return;
    const entries = { ...entriesNow(error), [name]: entry };
    setEntries(error, entries);
    if (same.has(error.id)) spread(error, entries);
  }

  function spread(from: ErrorInfo, entries = entriesNow(from)): void {
    for (const other of kindred(from, errors)) setEntries(other, takenOver(from, entries, other, entriesNow(other)));
  }

  function toggleSame(): void {
    if (!error) return;
    const next = new Set(same);
    if (!next.delete(error.id)) {
      next.add(error.id);
      spread(error);
    }
    setSame(next);
  }

  async function submit(): Promise<void> {
    if (ready && (await raise(errors, { gap: scans ?? 0, single }))) closeDialog();
  }

  const stateOf = (of: ErrorInfo): PageState => {
    if (bad(of)) return "bad";
    if (of.id === error.id) return "now";
    return seen.has(of.id) ? "done" : "open";
  };
  return (
    <Dialog
      title={t("errors.details")}
      about={about(needing.length, count)}
      width={800}
      onClose={closeDialog}
      onSubmit={() => void submit()}
      footer={
        <>
          <Gap form={gap} several={count > 1} onForm={setGap} />
          <span className="grow" />
          <button type="button" className="btn quiet" onClick={closeDialog}>
            {t("cancel")}
          </button>
          {pages.length > 1 && (
            <>
              <button type="button" className="btn" disabled={page === 0} onClick={() => goTo(page - 1)}>
                {t("dialog.back")}
              </button>
              <button type="button" className="btn" disabled={page >= pages.length - 1} onClick={() => goTo(page + 1)}>
                {t("dialog.next")}
              </button>
            </>
          )}
          <button type="submit" className="btn primary" disabled={!ready} title={forbidden ?? undefined}>
            {plain ? t("errors.generate.many", { count }) : t("errors.arm.many", { count })}
          </button>
        </>
      }
    >
      <div className="pagesof">
        <PageList pages={pages} stateOf={stateOf} now={error.id} onPage={(index) => goTo(index)} />
        <div className="pagebody" role="group" aria-label={t("dialog.page", { name: error.name })}>
          <DetailsPage
            key={error.id}
            error={error}
            entries={entriesNow(error)}
            alike={kindred(error, errors)}
            same={same.has(error.id)}
            onEntry={change}
            onSame={toggleSame}
          />
          <Preview wanted={wantedNow(state, errors)} of={error.id} valid={!errors.some(bad)} now={plain} />
        </div>
      </div>
      <ShapeFields />
      <DialogRefusal />
    </Dialog>
  );
}

function about(needing: number, total: number): string {
  if (needing === 0) return t("dialog.about.none");
  return t("dialog.about", { needing, total, count: total });
}

/** The PLC's refusal is shown here, and the entries stay as they are. */
function DialogRefusal() {
  const outcome = useSimulator((state) => state.outcome);
  const { errors: known } = useCatalogue();
  if (!outcome || outcome.ok) return null;
  return (
    <p className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        {inNames(known, outcome.message) || t("notsent.about")} <WayOn outcome={outcome} onDone={closeDialog} />
      </span>
    </p>
  );
}
