import { expect, type Locator } from '@playwright/test';

/** Clicks a tab and waits until it is in front: the dock brings it there in the next frame, and would cover what is shown before that. */
export async function toFront(tab: Locator): Promise<void> {
  await tab.click();
  await expect(tab).toHaveAttribute('aria-selected', 'true');
}
