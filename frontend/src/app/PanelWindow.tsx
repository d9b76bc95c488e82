import { useEffect, useState } from "react";
import { linkPath, readLink } from "../logic/plc/links";
import { showState } from "../logic/plc/plcstate";
import { panelName } from "../logic/project/panelFiles";
import { OperatorPanel } from "../panels/operator/OperatorPanel";
import { Banners } from "../panels/run/banner/Banners";
import { useBench } from "../store/plc/bench";
import { useOnline, usePlc } from "../store/plc/plc";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { StateWord } from "../ui/StateWord";

/** The window of somebody who operates: one operator panel, and the state of its PLC. */
export function PanelWindow({ path }: { path: string }) {
  const instance = useBench((bench) => bench.instance);
  const online = useOnline();
  const state = usePlc((plc) => plc.state);
  const shown = showState(state, online);
  const name = panelName(path);
  const [wanted] = useState(() => readLink(location)?.instance);
  useEffect(() => {
    document.title = `${name} – Scanbench`;
  }, [name]);
  return (
    <main className="opalone" data-tone={shown.tone} data-link={online ? "open" : "lost"}>
      <header>
        <h1>{name}</h1>
        <span className="muted">{instance?.name}</span>
        {state && <StateWord tone={shown.tone} icon={shown.icon} word={shown.word} />}
        <span className="grow" />
        {instance && (
          <a className="link" href={linkPath({ instance: instance.id, scan: null, panel: null })}>
            {t("operator.back")}
          </a>
        )}
      </header>
      <Banners />
      {instance !== null && wanted !== instance.id ? (
        <p className="lonely">
          <Icon name="error" />
          {t("operator.wrongplc", { path })}
        </p>
      ) : (
        <OperatorPanel path={path} alone />
      )}
    </main>
  );
}
