/** The elements of page.html. */

export const element = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

/** One sentence over the scene, and its details; none: nothing. Text only, never markup. */
export function notice(text: string): void {
  element('notice').textContent = text;
  element('notice').hidden = text === '';
}
