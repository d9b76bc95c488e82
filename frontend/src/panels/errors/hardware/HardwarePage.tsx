import { type KeyboardEvent, useEffect, useState } from "react";
import { type Fitted, HARDWARE, kindsOf, readFitted } from "../../../logic/errors/hardware";
import { messageOf } from "../../../logic/format/messageOf";
import {
  beginHardware,
  followNumbers,
  redoHardware,
  saveHardware,
  undoHardware,
  useHardwareEdited,
} from "../../../store/errors/hardware";
import { openFile } from "../../../store/page/navigate";
import { useBench } from "../../../store/plc/bench";
import { openDocument, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Empty } from "../../../ui/Empty";
import { Icon } from "../../../ui/Icon";
import { Trouble } from "../../../ui/Trouble";
import type { Problem } from "../../../wire/types";
import { Kind } from "./Kind";
import { Slots } from "./Slots";
import "./hardware.css";

/** What is fitted: the racks and units of the PLC, and the numbers with which its program raises errors. */
export function HardwarePage() {
  const project = useDocuments((documents) => documents.project);
  const exists = useDocuments(({ files }) => files.some(({ path }) => path === HARDWARE));
  const text = useDocuments(({ open }) => open[HARDWARE]?.text);
  const [trouble, setTrouble] = useState<string | null>(null);
  const failed = (why: unknown) => setTrouble(messageOf(why));
  // biome-ignore lint/correctness/useExhaustiveDependencies: of a different project, or when its tab was closed, it is opened again
  useEffect(() => {
    if (exists && text === undefined)
      openDocument(HARDWARE).then(
        () => setTrouble(null),
        (why: unknown) => setTrouble(messageOf(why)),
      );
  }, [project, exists, text === undefined]);
  useEffect(followNumbers, []);

  function onKeyDown(event: KeyboardEvent): void {
    const key = event.key.toLowerCase();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || !["s", "y", "z"].includes(key)) return;
    event.preventDefault();
    if (key === "s") void saveHardware();
    else if (key === "y" || event.shiftKey) redoHardware();
    else undoHardware();
  }

  return (
    <section
      className="pane flexcol hardware"
      data-pane="hardware"
      aria-label={t("hardware.title")}
      onKeyDown={onKeyDown}
    >
      {project === null && <p className="lonely faint">{t("hardware.noproject")}</p>}
      <Trouble text={trouble} />
      {project !== null && !exists && text === undefined && (
        <NoHardware onBegin={() => void beginHardware().then(() => setTrouble(null), failed)} />
      )}
      {exists && text === undefined && trouble === null && <p className="lonely faint">{t("hardware.loading")}</p>}
      {text !== undefined && <Shown text={text} />}
    </section>
  );
}

function NoHardware({ onBegin }: { onBegin: () => void }) {
  return (
    <Empty
      title={t("hardware.empty.title")}
      about={t("hardware.empty.about")}
      ways={[
        { icon: "list", strong: t("hardware.empty.rows"), rest: t("hardware.empty.rows.rest") },
        { icon: "info", strong: t("hardware.empty.names"), rest: t("hardware.empty.names.rest") },
      ]}
    >
      <button type="button" className="btn primary" onClick={onBegin}>
        {t("hardware.begin")}
      </button>
    </Empty>
  );
}

function Shown({ text }: { text: string }) {
  const fitted = readFitted(text);
  const problems = useDocuments((documents) => documents.problems).filter(({ file }) => file === HARDWARE);
  const apart = problems.filter(({ line }) => !fitted?.some(({ first, last }) => first <= line && line <= last));
  return (
    <>
      <Toolbar />
      <Apart problems={apart} unreadable={fitted === null} />
      {fitted && <Body fitted={fitted} problems={problems} />}
    </>
  );
}

function Toolbar() {
  const edited = useHardwareEdited();
  return (
    <div className="sub" role="toolbar" aria-label={t("hardware.title")}>
      <span className="faint cut">{edited ? t("unsaved") : t("hardware.build")}</span>
      <span className="grow" />
      <button type="button" className="btn quiet sm" title="Ctrl+Z" onClick={() => undoHardware()}>
        {t("hardware.undo")}
      </button>
      <button type="button" className="btn quiet sm" onClick={() => openFile(HARDWARE)}>
        {t("hardware.openfile")}
      </button>
      <button type="button" className="btn sm" title="Ctrl+S" disabled={!edited} onClick={() => void saveHardware()}>
        {t("hardware.save")}
      </button>
    </div>
  );
}

/** What is wrong with the file, and not with one thing in it. */
function Apart({ problems, unreadable }: { problems: readonly Problem[]; unreadable: boolean }) {
  if (problems.length === 0 && !unreadable) return null;
  return (
    <div className="trouble st fatal" role="alert">
      <Icon name="error" small />
      <span>
        {unreadable && `${t("hardware.unreadable")} `}
        {problems.map(({ line, column, message }) => (
          <button
            key={`${line}:${column}:${message}`}
            type="button"
            className="link plain"
            onClick={() => openFile(HARDWARE, line, column)}
          >
            {`${HARDWARE}:${line}: ${message}`}
          </button>
        ))}
      </span>
    </div>
  );
}

function Body({ fitted, problems }: { fitted: readonly Fitted[]; problems: readonly Problem[] }) {
  const fits = useBench((bench) => bench.model?.fits) ?? [];
  const kinds = kindsOf(fits);
  const strange = fitted.filter(({ item }) => !kinds.some(({ kind }) => kind === item.kind));
  const racks = fits.find(({ kind }) => kind === "rack");
  const slots = fits.find(({ kind }) => kind === "slot");
  return (
    <div className="hwbody scroll">
      {racks && slots && <Slots fitted={fitted} racks={racks} slots={slots} kinds={kinds} />}
      {strange.length > 0 && <Kind range={null} fitted={strange} all={fitted} problems={problems} />}
      {kinds.map((range) => (
        <Kind
          key={range.kind}
          range={range}
          fitted={fitted.filter(({ item }) => item.kind === range.kind)}
          all={fitted}
          problems={problems}
        />
      ))}
    </div>
  );
}
