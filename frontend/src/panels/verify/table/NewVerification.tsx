import { useEffect, useState } from "react";
import { isWholeScan, scanTyped } from "../../../logic/verify/verify";
import { loadInstances, useSeenAs } from "../../../store/debug/seenAs";
import { useForbidden } from "../../../store/plc/plc";
import { liveScan, useTimeline } from "../../../store/plc/timeline";
import { useDocuments } from "../../../store/project/documents";
import { beginVerification, reasonOf, stopAsking, type VerifyWish } from "../../../store/verify/verify";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";
import { FormDialog } from "../../../ui/FormDialog";
import { Segments } from "../../../ui/Segments";
import type { NewVerification as Wanted } from "../../../wire/types";

const LIMIT = 4096;
type What = "scan" | "pou" | "lines";

/** Asks what to verify, and when. A refusal is shown beside its field; no entry is lost. */
export function NewVerification({ wish }: { wish: VerifyWish }) {
  const { range, stretch } = wish;
  const pous = useDocuments((documents) => documents.pous).filter((pou) =>
    ["program", "function_block", "function", "class"].includes(pou.kind),
  );
  const files = [...new Set(pous.map(({ file }) => file))];
  const kept = useTimeline((run) => run.info?.first_scan ?? 0);
  const forbiddenLive = useForbidden("run");
  const [what, setWhat] = useState<What>(isWholeScan(range) ? "scan" : range.file ? "lines" : "pou");
  const [pou, setPou] = useState(range.pou || (pous[0]?.name ?? ""));
  const [file, setFile] = useState(range.file || (files[0] ?? ""));
  const [lines, setLines] = useState({ first: String(range.first || ""), last: String(range.last || "") });
  const [instance, setInstance] = useState(range.instance ?? "");
  const [past, setPast] = useState(stretch !== null);
  const [scans, setScans] = useState({
    first: String(stretch?.first ?? Math.max(kept, liveScan() - 1000)),
    last: String(stretch?.last ?? Math.max(kept, liveScan() - 1)),
  });
  const [pace, setPace] = useState<Wanted["pace"]>("free");
  const [limit, setLimit] = useState(String(LIMIT));
  const around = what === "pou" ? pou : "";
  const instances = useInstances(around);

  function wanted(): Wanted | string {
    const first = scanTyped(scans.first);
    const last = scans.last.trim() === "" ? null : scanTyped(scans.last);
    if (past && first === null) return t("verify.new.scans.bad");
    if (past && scans.last.trim() !== "" && last === null) return t("verify.new.scans.bad");
    if (past && last !== null && first !== null && last < first) return t("verify.new.scans.order");
    const most = scanTyped(limit);
    if (most === null || most < 1 || most > 1_000_000) return t("verify.new.limit.bad");
    const from = lines.first.trim() === "" ? 0 : scanTyped(lines.first);
    const to = lines.last.trim() === "" ? from : scanTyped(lines.last);
    if (what === "lines" && (from === null || to === null)) return t("verify.new.lines.bad");
    return {
      range: {
        pou: what === "pou" ? pou : "",
        file: what === "lines" ? file : "",
        first: what === "lines" ? (from ?? 0) : 0,
        last: what === "lines" ? (to ?? 0) : 0,
        instance: what === "pou" ? instance : (range.instance ?? ""),
      },
      pace: past ? "free" : pace,
      first: past ? first : null,
      last: past ? last : null,
      limit: most,
    };
  }

  async function submit(): Promise<void> {
    const asked = wanted();
    if (typeof asked === "string") throw new Error(asked);
    await beginVerification(asked).catch((error: unknown) => Promise.reject(new Error(reasonOf(error))));
  }

  return (
    <FormDialog
      title={t("verify.new.title")}
      about={t("verify.new.about")}
      width={520}
      submit={t("verify.begin")}
      onSubmit={submit}
      onClose={stopAsking}
    >
      <div className="vfnew">
        <span className="muted">{t("verify.new.what")}</span>
        <Segments
          label={t("verify.new.what")}
          value={what}
          options={(["scan", "pou", "lines"] as const).map((value) => ({ value, word: t(`verify.new.${value}`) }))}
          onChoose={setWhat}
        />
      </div>
      {what === "pou" && (
        <div className="vftwo">
          <Choice
            label={t("verify.new.pou.label")}
            value={pou}
            options={pous.map(({ name }) => name)}
            onChange={setPou}
          />
          <Choice
            label={t("verify.new.instance")}
            value={instance}
            options={["", ...instances]}
            word={(path) => path || t("verify.new.instance.all")}
            onChange={setInstance}
          />
        </div>
      )}
      {what === "lines" && (
        <div className="vfthree">
          <Choice label={t("verify.new.file")} value={file} options={files} onChange={setFile} />
          <Field
            label={t("verify.new.first")}
            value={lines.first}
            mono
            onChange={(first) => setLines({ ...lines, first })}
          />
          <Field
            label={t("verify.new.last")}
            value={lines.last}
            mono
            onChange={(last) => setLines({ ...lines, last })}
          />
        </div>
      )}
      <div className="vfnew">
        <span className="muted">{t("verify.new.when")}</span>
        <Segments
          label={t("verify.new.when")}
          value={past ? "past" : "live"}
          options={[
            { value: "live", word: t("verify.new.live") },
            { value: "past", word: t("verify.new.past"), icon: "past" },
          ]}
          onChoose={(chosen) => setPast(chosen === "past")}
        />
      </div>
      {past ? (
        <>
          <div className="vftwo">
            <Field
              label={t("verify.new.scan.first")}
              value={scans.first}
              mono
              onChange={(first) => setScans({ ...scans, first })}
            />
            <Field
              label={t("verify.new.scan.last")}
              value={scans.last}
              mono
              placeholder={t("verify.new.scan.end")}
              onChange={(last) => setScans({ ...scans, last })}
            />
          </div>
          <p className="hint">{t("verify.new.past.about", { first: kept, last: Math.max(kept, liveScan() - 1) })}</p>
        </>
      ) : (
        <>
          <div className="vfnew">
            <span className="muted">{t("verify.pace")}</span>
            <Segments
              label={t("verify.pace")}
              value={pace}
              disabled={forbiddenLive}
              options={(["free", "scan", "step"] as const).map((value) => ({
                value,
                word: t(`verify.pace.${value}`),
              }))}
              onChoose={setPace}
            />
          </div>
          <p className="hint">{t(`verify.pace.${pace}.about`)}</p>
        </>
      )}
      <div className="vftwo">
        <Field label={t("verify.new.limit")} value={limit} mono onChange={setLimit} />
        <p className="hint vfend">{t("verify.new.limit.about")}</p>
      </div>
    </FormDialog>
  );
}

function useInstances(pou: string): readonly string[] {
  useEffect(() => {
    if (pou) void loadInstances(pou);
  }, [pou]);
  return useSeenAs(({ instances }) => instances.get(pou.toUpperCase())) ?? [];
}

interface ChoiceProps {
  label: string;
  value: string;
  options: readonly string[];
  word?: (option: string) => string;
  onChange: (value: string) => void;
}

function Choice({ label, value, options, word = (option) => option, onChange }: ChoiceProps) {
  const all = options.includes(value) ? options : [value, ...options];
  return (
    <label className="field">
      <span>{label}</span>
      <select className="inp" value={value} onChange={(event) => onChange(event.target.value)}>
        {all.map((option) => (
          <option key={option} value={option}>
            {word(option)}
          </option>
        ))}
      </select>
    </label>
  );
}
