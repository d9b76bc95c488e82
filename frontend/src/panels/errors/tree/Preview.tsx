import { useContext, useState } from "react";
import { inNames } from "../../../logic/errors/catalogue";
import { grouped } from "../../../logic/format/numbers";
import { useCatalogue } from "../../../store/errors/catalogue";
import { usePreview } from "../../../store/errors/preview";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";
import { InSight } from "../../../ui/inSight";
import type { GenerateOne, PreviewedWrite } from "../../../wire/types";

interface Props {
  /** What would be raised. */
  wanted: readonly GenerateOne[];
  /** Of several errors, the one whose page is open: its writes come first. */
  of?: string;
  /** False while an entry is refused: then nothing is requested. */
  valid: boolean;
  again?: boolean;
  /** False when it is raised later: by then it may write something else. */
  now?: boolean;
  /** Although it is not fitted. */
  anyway?: boolean;
  /** Each write says which error it is of. */
  named?: boolean;
}

/** What raising these errors would write, address by address. */
export function Preview({ wanted, of, valid, again = false, now = true, anyway = false, named = false }: Props) {
  // While a different tab is in front nothing is asked, whatever comes and goes.
  const inSight = useContext(InSight);
  // A preview of writes from now on says nothing about a scan in the past.
  const past = usePlc((plc) => Boolean(plc.state?.past));
  const { preview, refused } = usePreview(valid && !past && inSight ? wanted : null, again, anyway);
  const { errors: known } = useCatalogue();
  // While the PLC runs, the scan number is over before anybody reads it.
  const running = usePlc((plc) => plc.state?.state === "running");
  const [all, setAll] = useState(false);
  const several = of !== undefined && wanted.length > 1;
  const writes = preview?.writes ?? [];
  const shown = several && !all ? writes.filter((write) => write.error === of || write.error === "") : writes;
  if (past) return null;
  const title = again ? "preview.change" : now ? "preview.title" : "preview.title.now";
  return (
    <section className="preview" aria-label={t("preview.title")} aria-busy={valid && !preview && !refused}>
      <div className="ph">
        <span className="cut">{t(title)}</span>
        {several && (
          <span className="seg sm" role="group" aria-label={t("preview.which")}>
            <button type="button" className={all ? "" : "on"} aria-pressed={!all} onClick={() => setAll(false)}>
              {t("preview.one")}
            </button>
            <button type="button" className={all ? "on" : ""} aria-pressed={all} onClick={() => setAll(true)}>
              {t("preview.all", { count: wanted.length })}
            </button>
          </span>
        )}
        {preview?.ok && !several && (
          <span>{running ? t("preview.seam") : t("preview.scan", { scan: grouped(preview.scan) })}</span>
        )}
      </div>
      {refused !== null && (
        <p className="hint bad">
          <Icon name="error" small />
          <span>{inNames(known, refused)}</span>
        </p>
      )}
      {!valid && <p className="faint">{t("preview.invalid")}</p>}
      {preview?.ok && shown.length === 0 && <p className="faint">{t("preview.none")}</p>}
      {shown.length > 0 && (
        <div className="writes">
          {shown
            .filter((write) => write.what !== "log")
            .map((write) => (
              <Write
                key={`${write.address} ${write.error} ${write.what}`}
                write={write}
                named={named || (several && all)}
              />
            ))}
          <LogWrites writes={shown.filter((write) => write.what === "log")} />
        </div>
      )}
      {preview && preview.more > 0 && <p className="faint">{t("preview.more", { count: preview.more })}</p>}
    </section>
  );
}

/** The device's own log takes several words for each error: they are summed up in one line until somebody unfolds them. */
function LogWrites({ writes }: { writes: readonly PreviewedWrite[] }) {
  const [open, setOpen] = useState(false);
  const [first] = writes;
  if (!first) return null;
  if (open) return writes.map((write) => <Write key={write.address} write={write} named={false} />);
  return (
    <div className="w">
      <span className="mono">{first.address} …</span>
      <button type="button" className="link" onClick={() => setOpen(true)}>
        {t("preview.words", { count: writes.length })}
      </button>
      <span className="cut">{t("preview.log")}</span>
    </div>
  );
}

function Write({ write, named }: { write: PreviewedWrite; named: boolean }) {
  const { byId } = useCatalogue();
  const { address, before, after, what, error } = write;
  const name = named && error ? ` · ${byId.get(error)?.name ?? error}` : "";
  return (
    <div className="w">
      <span className="mono">{address}</span>
      <span className="mono">{before === after ? t("preview.stays", { value: after }) : `${before} → ${after}`}</span>
      <span className="cut">
        {t(`preview.${what}`)}
        {name}
      </span>
    </div>
  );
}
