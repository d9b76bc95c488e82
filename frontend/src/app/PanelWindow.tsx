import { useState } from "react";
import { linkPath, readLink } from "../logic/plc/links";
import { panelName } from "../logic/project/panelFiles";
import { OperatorPanel } from "../panels/operator/OperatorPanel";
import { Banners } from "../panels/run/banner/Banners";
import { useBench } from "../store/plc/bench";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { StateWord } from "../ui/StateWord";
import { useFrame } from "./useFrame";

/** The window of somebody who operates: one operator panel, and the state of its PLC. */
export function PanelWindow({ path }: { path: string }) {
  const instance = useBench((bench) => bench.instance);
  const name = panelName(path);
  const [wanted] = useState(() => readLink(location)?.instance);
  const { frame, shown } = useFrame(name);
  return (
    <main className="opalone" {...frame}>
      <header>
        <h1>{name}</h1>
        <span className="muted">{instance?.name}</span>
        {shown && <StateWord tone={shown.tone} icon={shown.icon} word={shown.word} />}
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
