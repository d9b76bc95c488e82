import { useEffect, useRef, useState } from "react";
import { linkPath, readLink } from "../logic/plc/links";
import { OnlineChange } from "../panels/project/change/OnlineChange";
import { Banners } from "../panels/run/banner/Banners";
import { Past } from "../panels/run/past/Past";
import { Palette } from "../panels/shell/palette/Palette";
import { offerCommands } from "../store/page/palette";
import { useBench } from "../store/plc/bench";
import { t } from "../text";
import { Icon } from "../ui/Icon";
import { StateWord } from "../ui/StateWord";
import { windowCommands } from "./commands";
import { Dock, type DockHandle } from "./Dock";
import { Keys } from "./Keys";
import { installKeys } from "./keys";
import { useFrame } from "./useFrame";

/** A window with one panel, and whatever is opened from there: it works as the whole page does, and without it. */
export function LoneWindow({ panel }: { panel: string }) {
  const dock = useRef<DockHandle>(null);
  const instance = useBench((bench) => bench.instance);
  const [wanted] = useState(() => readLink(location)?.instance);
  const [title, setTitle] = useState("");
  const { frame, shown } = useFrame(title, instance?.name);
  useEffect(() => installKeys(), []);
  useEffect(() => {
    const arrangement = {
      resetLayout: () => dock.current?.reset(),
      enlarge: () => dock.current?.enlarge(),
      popOut: () => dock.current?.popOut(),
    };
    return offerCommands(() => windowCommands(arrangement));
  }, []);
  return (
    <div className="app lone" {...frame}>
      <div className="rail" />
      <header className="lonehead">
        <h1>{instance?.name}</h1>
        {shown && <StateWord tone={shown.tone} icon={shown.icon} word={shown.word} />}
        <span className="grow" />
        {instance && (
          <a className="link" href={linkPath({ instance: instance.id, scan: null, panel: null })}>
            {t("popout.back")}
          </a>
        )}
      </header>
      <div className="bannerslot">
        <Banners />
      </div>
      <main className="lonework">
        {instance !== null && wanted !== instance.id && (
          <p className="lonely">
            <Icon name="error" />
            {t("popout.wrongplc")}
          </p>
        )}
        {instance !== null && wanted === instance.id && <Dock ref={dock} alone={{ panel, onTitle: setTitle }} />}
      </main>
      <OnlineChange />
      <Past />
      <Palette />
      <Keys />
    </div>
  );
}
