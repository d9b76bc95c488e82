import { useState } from "react";
import { readController, useTraceImport } from "../../../store/verify/traceImport";
import { t } from "../../../text";
import { Field } from "../../../ui/Field";

const INTERVAL = "100";

/** A controller that runs, in place of a file: where it is, and how often it is read. */
export function ChooseController() {
  const reading = useTraceImport((state) => state.reading);
  const [address, setAddress] = useState("opc.tcp://");
  const [interval, setInterval] = useState(INTERVAL);
  const [nodes, setNodes] = useState("");
  const [user, setUser] = useState("");
  const [password, setPassword] = useState("");
  const ms = /^\d{2,5}$/.test(interval.trim()) ? Number(interval) : 0;
  const bad = ms < 10 || ms > 60_000;
  const known = /^(opc\.tcp|fins|fins\+tcp):\/\/[^/\s]+/i.test(address.trim());

  function connect(): void {
    const named = nodes
      .split("\n")
      .map((each) => each.trim())
      .filter(Boolean);
    void readController({ address: address.trim(), interval_ms: ms, nodes: named, user: user.trim(), password });
  }

  return (
    <details className="ticontroller">
      <summary>{t("import.controller")}</summary>
      <p className="faint">{t("import.controller.about")}</p>
      <div className="tifields">
        <Field label={t("import.controller.address")} value={address} onChange={setAddress} mono />
        <Field
          label={t("import.controller.interval")}
          value={interval}
          onChange={setInterval}
          refused={bad ? t("import.controller.interval.bad") : null}
        />
        <Field label={t("import.controller.user")} value={user} onChange={setUser} />
        <Field label={t("import.controller.secret")} value={password} onChange={setPassword} secret />
      </div>
      <label className="field">
        <span>{t("import.controller.nodes")}</span>
        <textarea
          className="inp mono"
          rows={2}
          value={nodes}
          spellCheck={false}
          placeholder="ns=4;s=Application.PLC_PRG.level"
          onChange={(event) => setNodes(event.target.value)}
        />
      </label>
      <button type="button" className="btn sm" disabled={reading !== null || bad || !known} onClick={connect}>
        {t("import.controller.connect")}
      </button>
    </details>
  );
}
