/** The code of an error as the page shows it. */
import { t } from "../../text";

/** The device has no code for some errors (of ports): then it says so. */
export const codeText = (code: string): string => code || t("errors.nocode");
