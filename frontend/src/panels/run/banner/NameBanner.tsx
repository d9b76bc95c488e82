import { useState } from "react";
import { isGuest } from "../../../logic/project/people";
import { chooseName, isNameKept, keepName, LONGEST_NAME } from "../../../store/plc/name";
import { usePlc } from "../../../store/plc/plc";
import { t } from "../../../text";
import { Icon } from "../../../ui/Icon";

/** Asks once for a name, when somebody else is here to see it. */
export function NameBanner() {
  const you = usePlc((plc) => plc.you?.name ?? "");
  const others = usePlc((plc) => plc.users.some(({ name, client }) => !client && name !== plc.you?.name));
  const [done, setDone] = useState(isNameKept);
  const [name, setName] = useState("");
  if (done || !others || !isGuest(you)) return null;
  const length = name.trim().length;
  const stay = () => {
    keepName();
    setDone(true);
  };
  return (
    <form
      className="banner info"
      aria-label={t("name.title")}
      onSubmit={(event) => {
        event.preventDefault();
        if (length > 0 && length <= LONGEST_NAME) void chooseName(name.trim()).then(() => setDone(true));
      }}
    >
      <Icon name="users" />
      <span className="grow">
        <b>{t("name.ask", { name: you })}</b> <span className="muted">{t("name.ask.about")}</span>
      </span>
      <input
        className="inp sm"
        aria-label={t("name.label")}
        placeholder={t("name.label")}
        aria-invalid={length > LONGEST_NAME}
        autoComplete="name"
        value={name}
        onChange={({ target }) => setName(target.value)}
      />
      {length > LONGEST_NAME && (
        <span className="hint bad" role="alert">
          {t("name.long", { longest: LONGEST_NAME, length })}
        </span>
      )}
      <button type="submit" className="btn sm" disabled={length === 0 || length > LONGEST_NAME}>
        {t("name.use")}
      </button>
      <button type="button" className="btn quiet sm" onClick={stay}>
        {t("name.stay", { name: you })}
      </button>
    </form>
  );
}
