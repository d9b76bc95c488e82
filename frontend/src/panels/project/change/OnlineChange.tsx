import { useState } from "react";
import { changeVerb } from "../../../logic/project/change";
import { build, useDocuments } from "../../../store/project/documents";
import { t } from "../../../text";
import { Dialog } from "../../../ui/Dialog";
import type { BuildResult } from "../../../wire/types";
import { OnePlc } from "./OnePlc";
import "./change.css";

/** A build waits for confirmation: the dialog shows what the new program would do to the variables of every running PLC. */
export function OnlineChange() {
  const asking = useDocuments((documents) => documents.asking);
  return asking && <Agreement key={asking.project.version} result={asking} />;
}

function Agreement({ result }: { result: BuildResult }) {
  const { project, changes } = result;
  const [left, setLeft] = useState<ReadonlySet<number>>(new Set());
  const chosen = changes.map(({ instance }) => instance).filter((instance) => !left.has(instance));
  const able = changes.some(({ refusal }) => refusal === "");
  const verb = changeVerb(changes, new Set(chosen));
  const close = () => useDocuments.setState({ asking: null });

  function toggle(instance: number): void {
    const next = new Set(left);
    if (!next.delete(instance)) next.add(instance);
    setLeft(next);
  }

  return (
    <Dialog
      title={t("change.title", { project: project.name, from: project.version, to: project.version + 1 })}
      about={t(able ? "change.about" : "change.about.refused")}
      width={720}
      onClose={close}
      onSubmit={() => void (verb !== null && build(true, chosen))}
      footer={
        <>
          <span className="hint grow cut" title={result.message}>
            {able && verb === null ? t("change.tick") : result.message}
          </span>
          <button type="button" className="btn quiet" onClick={close}>
            {t(able ? "cancel" : "close")}
          </button>
          {able && (
            <button type="submit" className="btn primary" disabled={verb === null}>
              {verb ?? t("change.do.none")}
            </button>
          )}
        </>
      }
    >
      <div className="changes">
        {changes.map((change) => (
          <OnePlc
            key={change.instance}
            change={change}
            chosen={change.refusal === "" && !left.has(change.instance)}
            onToggle={() => toggle(change.instance)}
          />
        ))}
      </div>
    </Dialog>
  );
}
