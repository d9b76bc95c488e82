import { useState } from "react";
import { messageOf } from "../../../logic/format/messageOf";
import { keepStateAs, shownScan } from "../../../store/errors/sweeps";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** One line in the dialog of a sweep: keeps the shown state of the PLC. Enter in the field does the same. */
export function KeepHere({ taken }: { taken: readonly string[] }) {
  const [name, setName] = useState("");
  const [refused, setRefused] = useState<string | null>(null);

  async function keepIt(): Promise<void> {
    const wanted = name.trim();
    if (wanted === "") setRefused(t("name.missing"));
    else if (taken.includes(wanted)) setRefused(t("states.taken", { name: wanted }));
    else {
      try {
        await keepStateAs(wanted, shownScan());
        setName("");
        setRefused(null);
      } catch (error) {
        setRefused(messageOf(error));
      }
    }
  }

  return (
    <div className="keephere">
      <div className="row">
        <input
          className={`inp sm grow${refused ? " bad" : ""}`}
          aria-label={t("states.keep.name")}
          aria-invalid={refused !== null}
          placeholder={t("states.keep.here")}
          value={name}
          maxLength={100}
          spellCheck={false}
          onChange={(event) => {
            setName(event.target.value);
            setRefused(null);
          }}
          onKeyDown={(event) => {
            if (event.key !== "Enter") return;
            event.preventDefault();
            void keepIt();
          }}
        />
        <button type="button" className="btn sm" onClick={() => void keepIt()}>
          {t("states.keep.do")}
        </button>
      </div>
      {refused && (
        <span className="hint bad" role="alert">
          <Icon name="error" small />
          {refused}
        </span>
      )}
    </div>
  );
}
